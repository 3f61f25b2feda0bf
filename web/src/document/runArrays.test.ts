import assert from "node:assert/strict";
import { describe, test } from "node:test";
import type { VertexData } from "../tessellate/faces.ts";
import { arraysOfRuns } from "./runArrays.ts";

/** A roof: two squares that meet at a right angle along the edge from vertex 1 to vertex 2. */
const roof: VertexData = {
  positions: [-1, 0, 0, 0, 1, 0, 0, 1, 1, -1, 0, 1, 1, 0, 0, 1, 0, 1],
  normals: [],
  texCoords: [],
  colors: [],
  colorComponents: 3,
};
const cornerOf = (position: number) => ({ position, normal: -1, texCoord: -1, color: -1 });
const slopes = [[3, 2, 1, 0].map(cornerOf), [2, 5, 4, 1].map(cornerOf)];
const style = { primitive: "triangles", ccw: true, convex: true, creaseAngle: 0 } as const;

describe("the arrays of runs of corners", () => {
  test("are two triangles for each square, with X3D's default texture coordinates", () => {
    const { arrays, layout } = arraysOfRuns(roof, slopes, style);
    assert.deepEqual(
      layout.corners.map(({ position }) => position),
      [3, 2, 1, 3, 1, 0, 2, 5, 4, 2, 4, 1],
    );
    // s runs along x, the longest side of the bounding box.
    assert.deepEqual(Array.from(arrays?.texCoords ?? []).slice(0, 4), [0, 0, 0.5, 0.5]);
  });

  test("have hard edges where faces meet at more than the crease angle, and smooth ones where at less", () => {
    const normalsOf = (creaseAngle: number) => {
      const normals =
        arraysOfRuns(roof, slopes, { ...style, creaseAngle }).arrays?.normals ?? assert.fail("no normals");
      return [1, 6].map((vertex) =>
        Array.from(normals.subarray(3 * vertex, 3 * vertex + 3), (x) => Math.round(10 * x)),
      );
    };
    assert.deepEqual(normalsOf(1), [
      [-7, 7, 0],
      [7, 7, 0],
    ]);
    assert.deepEqual(normalsOf(2), [
      [0, 10, 0],
      [0, 10, 0],
    ]);
  });

  test("face the other side where the runs are clockwise", () => {
    const { arrays } = arraysOfRuns(roof, slopes, { ...style, ccw: false });
    assert.ok((arrays?.normals?.[1] ?? 0) < 0);
  });

  test("of polygons that are not convex stay within their outline", () => {
    const arrow = { ...roof, positions: [0, 0, 0, 2, -1, 0, 0, 2, 0, -2, -1, 0] };
    const { arrays } = arraysOfRuns(arrow, [[3, 0, 1, 2].map(cornerOf)], { ...style, convex: false });
    const { positions = [] } = arrays ?? {};
    let area = 0;
    for (let first = 0; first < positions.length; first += 9) {
      const [ax = 0, ay = 0, , bx = 0, by = 0, , cx = 0, cy = 0] = positions.slice(first, first + 9);
      area += Math.abs((bx - ax) * (cy - ay) - (by - ay) * (cx - ax)) / 2;
    }
    assert.equal(area, 4);
  });

  test("are lines between the corners of each run, or its points, without normals", () => {
    const [run] = slopes;
    assert.ok(run);
    const lines = arraysOfRuns(roof, [run], { ...style, primitive: "lines" });
    assert.deepEqual(
      lines.layout.corners.map(({ position }) => position),
      [3, 2, 2, 1, 1, 0],
    );
    assert.equal(lines.arrays?.normals, undefined);
    assert.deepEqual(arraysOfRuns(roof, [run], { ...style, primitive: "points" }).layout.corners, run);
  });

  test("are none where a corner names a vertex that is missing", () => {
    assert.equal(arraysOfRuns(roof, [[0, 1, 6].map(cornerOf)], style).arrays, undefined);
  });
});
