import assert from "node:assert/strict";
import { test } from "node:test";
import { sceneOf } from "../document/scenes.testing.ts";
import { shapeInstancesIn } from "./shapeInstances.ts";

test("each instance of a shape counts, also in groups that are used again and where it is hidden", () => {
  const twice =
    '<Transform DEF="pair"><Shape><Box/></Shape><Group><Shape visible="false"><Box/></Shape></Group></Transform>';
  assert.equal(shapeInstancesIn(sceneOf("<PointLight/>").root), 0);
  assert.equal(shapeInstancesIn(sceneOf(`<Shape/>${twice}<Transform USE="pair"/>`).root), 5);
});
