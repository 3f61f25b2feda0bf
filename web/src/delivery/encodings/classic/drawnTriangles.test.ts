import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { drawnTriangles } from "./drawnTriangles.ts";

const index = Uint16Array.from({ length: 20 }, (_, corner) => 100 + corner);

describe("the triangles that are drawn", () => {
  test("are the index itself where every draw has whole triangles", () => {
    const draws = [
      { primitive: "triangles", first: 0, count: 12 },
      { primitive: "triangles", first: 12, count: 6 },
    ] as const;
    assert.equal(drawnTriangles(index, draws), index);
  });

  test("leave out the corners of each draw that complete no triangle", () => {
    const draws = [
      { primitive: "triangles", first: 0, count: 5 },
      { primitive: "triangles", first: 5, count: 7 },
    ] as const;
    assert.deepEqual(Array.from(drawnTriangles(index, draws) ?? []), [100, 101, 102, 105, 106, 107, 108, 109, 110]);
  });

  test("are none where lines or points are drawn, too", () => {
    const draws = [
      { primitive: "triangles", first: 0, count: 6 },
      { primitive: "lines", first: 6, count: 2 },
    ] as const;
    assert.equal(drawnTriangles(index, draws), undefined);
  });
});
