import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { TestRandom } from "./rangeEncoder.testing.ts";
import { orderForVertexCache } from "./vertexCache.ts";

function trianglesOf(corners: Int32Array): string[] {
  return Array.from({ length: corners.length / 3 }, (_, t) => corners.subarray(3 * t, 3 * t + 3).join(" ")).sort();
}

/** Vertices that a cache of the latest `size` must fetch, for each triangle. */
function missesPerTriangle(corners: Int32Array, size: number): number {
  const cache: number[] = [];
  let misses = 0;
  for (const v of corners) {
    if (cache.includes(v)) continue;
    misses += 1;
    cache.push(v);
    if (cache.length > size) cache.shift();
  }
  return misses / (corners.length / 3);
}

/** A square of n x n quads, row by row: rows are longer than a cache. */
function gridOf(n: number): Int32Array {
  const corners: number[] = [];
  for (let y = 0; y < n; ++y) {
    for (let x = 0; x < n; ++x) {
      const a = y * (n + 1) + x;
      corners.push(a, a + 1, a + n + 2, a, a + n + 2, a + n + 1);
    }
  }
  return Int32Array.from(corners);
}

describe("the order for the vertex cache", () => {
  test("keeps every triangle and how it is turned, whatever they are", () => {
    const random = new TestRandom(3);
    for (let round = 0; round < 200; ++round) {
      const vertexCount = 1 + random.below(40);
      const corners = Int32Array.from({ length: 3 * random.below(120) }, () => random.below(vertexCount));
      assert.deepEqual(trianglesOf(orderForVertexCache(corners, vertexCount)), trianglesOf(corners));
    }
  });

  test("makes two thirds of a vertex fetch of more than one", () => {
    const corners = gridOf(100);
    assert.ok(missesPerTriangle(corners, 16) > 1);
    const ordered = orderForVertexCache(corners, 101 * 101);
    assert.ok(missesPerTriangle(ordered, 16) < 0.72, String(missesPerTriangle(ordered, 16)));
    assert.ok(missesPerTriangle(ordered, 32) < 0.7, String(missesPerTriangle(ordered, 32)));
  });

  test("takes linear time, also around one vertex that all share", () => {
    const milliseconds = (triangles: number) => {
      const corners = Int32Array.from({ length: 3 * triangles }, (_, c) => (c % 3 === 0 ? 0 : 1 + Math.floor(c / 3) + c % 3));
      const before = process.cpuUsage().user;
      orderForVertexCache(corners, triangles + 4);
      return (process.cpuUsage().user - before) / 1000;
    };
    milliseconds(100_000);
    assert.ok(milliseconds(400_000) < 3000);
  });
});
