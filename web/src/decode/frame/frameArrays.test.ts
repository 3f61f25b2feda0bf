// Tests that frames are the same integers in arrays as in images, and the normals that follow from their triangles.

import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, test } from "node:test";
import type { VertexArray } from "../../stage/vertexArray.ts";
import { triangleNormals } from "../vertexNormals.ts";
import { frameArrays } from "./frameArrays.ts";
import { frameImages } from "./frameImages.ts";

const directory = join(import.meta.dirname, "../../../../vectors/frame-1");
const names = readdirSync(directory).filter((name) => name.endsWith(".igf"));

/** Component `c` of vertex `n` in images of byte planes. */
const inPlanes = (planes: readonly Uint8Array[], n: number, c: number) =>
  planes.reduce((sum, texels) => 256 * sum + (texels[4 * n + c] ?? 0), 0);
const inArray = (vertices: VertexArray | undefined, n: number, c: number) =>
  vertices?.array[n * vertices.stride + vertices.offset + c];

describe("frames in arrays", () => {
  for (const name of names) {
    test(`${name} has the integers of its images`, async () => {
      const bytes = Uint8Array.from(readFileSync(join(directory, name)));
      const images = await frameImages(bytes);
      const arrays = await frameArrays({ bytes, normalSource: undefined });
      const { header } = arrays;
      assert.deepEqual(header, images.header);
      for (let n = 0; n < header.vertices; ++n) {
        for (let c = 0; c < 3; ++c) assert.equal(inArray(arrays.coord, n, c), inPlanes(images.coord, n, c));
        for (let c = 0; c < header.colorComponents; ++c)
          assert.equal(inArray(arrays.color, n, c), images.color?.[4 * n + c]);
        for (let c = 0; c < header.valueComponents; ++c)
          assert.equal(inArray(arrays.value, n, c), inPlanes(images.value, n, c));
        for (let c = 0; c < 2 && images.normal; ++c)
          assert.equal(
            inArray(arrays.normal, n, c),
            256 * (images.normal[4 * n + c] ?? 0) + (images.normal[4 * n + 2 + c] ?? 0),
          );
      }
      assert.equal(arrays.normal === undefined, header.normalBits === 0);
    });
  }

  test("a frame without normals gets those of its grid or of its triangles", async () => {
    const bytes = Uint8Array.from(readFileSync(join(directory, "grid.igf")));
    const { header, coord } = await frameArrays({ bytes, normalSource: undefined });
    const grid = { kind: "geometryImage", columns: header.columns, rows: header.vertices / header.columns } as const;
    const front = await frameArrays({ bytes, normalSource: { kind: "grid", grid, ccw: true } });
    const back = await frameArrays({ bytes, normalSource: { kind: "grid", grid, ccw: false } });
    const index = Uint16Array.of(0, header.columns, 1);
    const triangles = await frameArrays({ bytes, normalSource: { kind: "triangles", index } });
    const length = (vertices: VertexArray | undefined, n: number) =>
      Math.hypot(...[0, 1, 2].map((c) => inArray(vertices, n, c) ?? 0));
    for (let n = 0; n < header.vertices; ++n) {
      assert.ok(Math.abs(length(front.normal, n) - 1) < 1e-6);
      assert.ok(Math.abs(length(triangles.normal, n) - 1) < 1e-6);
      for (let c = 0; c < 3; ++c)
        assert.ok(Math.abs((inArray(front.normal, n, c) ?? 0) + (inArray(back.normal, n, c) ?? 0)) < 1e-6);
    }
    assert.deepEqual(coord.array, front.coord.array);
  });
});

describe("normals of triangles", () => {
  test("are sums of the triangles' areas", () => {
    const points = { array: Uint16Array.of(0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 4), stride: 3 };
    // A triangle of area 2 that faces +z, and one of area 4 that faces +x, share the vertices 0 and 2.
    const normals = triangleNormals(points, 4, Uint8Array.of(0, 1, 2, 0, 2, 3));
    const shared = [2 / Math.sqrt(5), 0, 1 / Math.sqrt(5)];
    for (const [vertex, expected] of [
      [0, shared],
      [1, [0, 0, 1]],
      [2, shared],
      [3, [1, 0, 0]],
    ] as const)
      expected.forEach((component, c) => {
        assert.ok(Math.abs((normals[3 * vertex + c] ?? 0) - component) < 1e-6, `vertex ${vertex}`);
      });
  });

  test("of vertices in no triangle, or only in those without an area, are 0 0 1", () => {
    const points = { array: Uint16Array.of(1, 2, 3, 4, 5, 6, 7, 8, 9), stride: 3 };
    const normals = triangleNormals(points, 3, Uint8Array.of(0, 0, 1));
    assert.deepEqual(
      Array.from(normals),
      Array.from({ length: 9 }, (_, n) => (n % 3 === 2 ? 1 : 0)),
    );
  });
});
