import assert from "node:assert/strict";
import { test } from "node:test";
import { makeIndex } from "./indexArray.ts";

test("an index array has 16 bits as long as no vertex has the index of WebGL 2's primitive restart", () => {
  assert.ok(makeIndex(65535, 3) instanceof Uint16Array);
  assert.ok(makeIndex(65536, 3) instanceof Uint32Array);
  assert.equal(makeIndex(4, 6).length, 6);
});
