import assert from "node:assert/strict";
import { test } from "node:test";
import { trianglesFromStrip } from "./strips.ts";

test("indices of a strip become its triangles, with their orientation, and with degenerate ones", () => {
  const strip = Uint16Array.from([0, 1, 2, 3, 3, 4, 4, 5, 6]);
  assert.deepEqual(
    Array.from(trianglesFromStrip(strip)),
    [0, 1, 2, 2, 1, 3, 2, 3, 3, 3, 3, 4, 3, 4, 4, 4, 4, 5, 4, 5, 6],
  );
  assert.equal(trianglesFromStrip(Uint16Array.from([0, 1])).length, 0);
  assert.equal(trianglesFromStrip(new Uint16Array()).length, 0);
});
