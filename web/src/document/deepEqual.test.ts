import assert from "node:assert/strict";
import { test } from "node:test";
import { deepEqual } from "./deepEqual.ts";

test("descriptions are equal where every value is", () => {
  const description = () => ({
    kind: "phong",
    color: [1, 0.5, 0],
    texture: undefined,
    alpha: { mode: "AUTO", cutoff: Infinity },
  });
  assert.ok(deepEqual(description(), description()));
  assert.ok(!deepEqual(description(), { ...description(), color: [1, 0.5, 0.1] }));
  assert.ok(!deepEqual(description(), { ...description(), color: [1, 0.5] }));
  assert.ok(!deepEqual(description(), { ...description(), texture: { url: "" } }));
  assert.ok(!deepEqual(description(), { kind: "phong" }));
  assert.ok(!deepEqual({ kind: "phong" }, description()));
  assert.ok(!deepEqual({ texture: undefined }, { points: undefined }));
  assert.ok(!deepEqual({}, null));
});
