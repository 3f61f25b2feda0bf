import assert from "node:assert/strict";
import { test } from "node:test";
import { maxMeshBytesOf } from "./meshMemory.ts";

test("the meshes of a scene take at most 256 MiB, and 96 MiB on phones and tablets", () => {
  const device = (isTouched: boolean) => (query: string) => {
    assert.match(query, /pointer: coarse/);
    return { matches: isTouched };
  };
  assert.equal(maxMeshBytesOf(device(false)), 256 * 2 ** 20);
  assert.equal(maxMeshBytesOf(device(true)), 96 * 2 ** 20);
  assert.equal(maxMeshBytesOf(undefined), 256 * 2 ** 20, "without a window");
});
