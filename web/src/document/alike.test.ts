import assert from "node:assert/strict";
import { test } from "node:test";
import { areAlike } from "./alike.ts";

test("descriptions are alike where every value is", () => {
  const description = () => ({
    kind: "phong",
    color: [1, 0.5, 0],
    texture: undefined,
    alpha: { mode: "AUTO", cutoff: Infinity },
  });
  assert.ok(areAlike(description(), description()));
  assert.ok(!areAlike(description(), { ...description(), color: [1, 0.5, 0.1] }));
  assert.ok(!areAlike(description(), { ...description(), color: [1, 0.5] }));
  assert.ok(!areAlike(description(), { ...description(), texture: { url: "" } }));
  assert.ok(!areAlike(description(), { kind: "phong" }));
  assert.ok(!areAlike({ kind: "phong" }, description()));
  assert.ok(!areAlike({ texture: undefined }, { points: undefined }));
  assert.ok(!areAlike({}, null));
});
