import assert from "node:assert/strict";
import { test } from "node:test";
import type { GroupDescription } from "./description.ts";
import { shapesOf } from "./description.ts";
import { elementsOf } from "./elements.testing.ts";
import { readScene } from "./readScene.ts";

function groupIn(markup: string): GroupDescription {
  const [group] = readScene(elementsOf(`<X3D>${markup}</X3D>`)).root.children;
  assert.ok(group?.kind === "group");
  return group;
}

test("an Anchor has its URLs, description and target", () => {
  const { anchor, children } = groupIn(
    `<Anchor url='"a.html" "#there"' description="A" parameter='"x=y" "target=_blank"'><Shape/></Anchor>`,
  );
  assert.deepEqual(
    [anchor?.urls, anchor?.description, anchor?.target, children.length],
    [["a.html", "#there"], "A", "_blank", 1],
  );
  assert.equal(groupIn("<Anchor><Shape/></Anchor>").anchor, undefined);
  assert.equal(groupIn('<Anchor url="a.html"/>').anchor?.target, "");
});

test("a Collision's proxy is not drawn", () => {
  const shapes = shapesOf(groupIn('<Collision><Shape id="a"/><Shape id="b" containerField="proxy"/></Collision>'));
  assert.deepEqual(
    shapes.map(({ element }) => element.getAttribute("id")),
    ["a"],
  );
});

test("a Billboard rotates about the y axis, or about its axisOfRotation", () => {
  assert.deepEqual(groupIn("<Billboard/>").billboardAxis, [0, 1, 0]);
  assert.deepEqual(groupIn('<Billboard axisOfRotation="0 0 0"/>').billboardAxis, [0, 0, 0]);
});
