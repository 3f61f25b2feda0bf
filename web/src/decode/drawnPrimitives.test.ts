import assert from "node:assert/strict";
import { test } from "node:test";
import { drawnPrimitives, trianglesFromStrip } from "./drawnPrimitives.ts";

test("indices of a strip become its triangles, with their orientation, and with degenerate ones", () => {
  const strip = Uint16Array.from([0, 1, 2, 3, 3, 4, 4, 5, 6]);
  assert.deepEqual(
    Array.from(trianglesFromStrip(strip)),
    [0, 1, 2, 2, 1, 3, 2, 3, 3, 3, 3, 4, 3, 4, 4, 4, 4, 5, 4, 5, 6],
  );
  assert.equal(trianglesFromStrip(Uint16Array.from([0, 1])).length, 0);
  assert.equal(trianglesFromStrip(new Uint16Array()).length, 0);
});

test("fans become triangles and loops line strips; other draws of the patch keep their indices", () => {
  const index = Uint16Array.from([4, 5, 6, 7, 0, 1, 2, 9, 8]);
  const { index: drawnIndex, draws } = drawnPrimitives(
    index,
    [
      { primitive: "triangleFan", first: 0, count: 4 },
      { primitive: "lineLoop", first: 4, count: 3 },
      { primitive: "points", first: 7, count: 2 },
    ],
    true,
  );
  assert.deepEqual(Array.from(drawnIndex), [4, 5, 6, 4, 6, 7, 0, 1, 2, 0, 9, 8]);
  assert.deepEqual(draws, [
    { primitive: "triangles", first: 0, count: 6 },
    { primitive: "lineStrip", first: 6, count: 4 },
    { primitive: "points", first: 10, count: 2 },
  ]);
});

test("a clockwise front exchanges two corners of every triangle, with and without an index", () => {
  const strip = [{ primitive: "triangleStrip", first: 0, count: 4 }] as const;
  assert.deepEqual(Array.from(drawnPrimitives(undefined, strip, false).index ?? []), [0, 2, 1, 2, 3, 1]);
  const triangles = [{ primitive: "triangles", first: 0, count: 3 }] as const;
  assert.deepEqual(Array.from(drawnPrimitives(Uint8Array.from([7, 8, 9]), triangles, false).index), [7, 9, 8]);
});

test("draws that are drawn as stated keep their arrays", () => {
  const index = Uint8Array.from([0, 1, 2]);
  const triangles = [{ primitive: "triangles", first: 0, count: 3 }] as const;
  assert.equal(drawnPrimitives(index, triangles, true).index, index);
  const lines = [{ primitive: "lines", first: 0, count: 2 }] as const;
  assert.equal(drawnPrimitives(undefined, lines, false).index, undefined);
});

test("loops and fans of too few corners draw nothing", () => {
  for (const primitive of ["lineLoop", "triangleFan"] as const)
    assert.equal(drawnPrimitives(undefined, [{ primitive, first: 0, count: 1 }], true).draws[0]?.count, 0);
});
