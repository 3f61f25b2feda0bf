import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { TestRandom } from "./rangeEncoder.testing.ts";
import { orderForVertexCache } from "./vertexCache.ts";

function trianglesOf(corners: Int32Array | Uint32Array): string[] {
  return Array.from({ length: corners.length / 3 }, (_, t) => corners.subarray(3 * t, 3 * t + 3).join(" ")).sort();
}

/** Vertices for each triangle that a cache of the latest `size` vertices must fetch. */
function missesPerTriangle(corners: Int32Array | Uint32Array, size: number): number {
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

interface Fans {
  readonly corners: Int32Array;
  readonly fans: Int32Array;
}

/** A square of n x n quads, row by row as if rows were rings; they are longer than a cache. */
function squareOf(n: number): Fans {
  const corners: number[] = [];
  const fans: number[] = [];
  for (let y = 0; y < n; ++y) {
    for (let x = 0; x <= n; ++x) {
      const a = y * (n + 1) + x;
      if (x < n) corners.push(a, a + 1, a + n + 2, a, a + n + 2, a + n + 1);
      // The nodes after the first node are the first row; each node is followed by one node of the next row.
      fans.push(corners.length / 3, Math.min(a + n + 2, n * (n + 1)));
    }
  }
  return { corners: Int32Array.from(corners), fans: Int32Array.from(fans) };
}

/** Nodes that have random numbers of triangles and of nodes in their fans. */
function randomFans(random: TestRandom): Fans {
  const nodeCount = 1 + random.below(60);
  const fans: number[] = [];
  let [triangles, nodes] = [0, 1];
  for (let node = 0; node < nodeCount; ++node) {
    triangles += random.below(4);
    nodes = node + 1 === nodeCount ? nodeCount : Math.min(nodeCount, Math.max(nodes + random.below(4), node + 2));
    fans.push(triangles, nodes);
  }
  return { corners: Int32Array.from({ length: 3 * triangles }, () => random.below(40)), fans: Int32Array.from(fans) };
}

function order({ corners, fans }: Fans): Uint32Array {
  return orderForVertexCache(corners, fans, new Uint32Array(corners.length));
}

describe("the order for the vertex cache", () => {
  test("keeps every triangle and the order of its corners, whatever the fans are", () => {
    const random = new TestRandom(3);
    for (let round = 0; round < 300; ++round) {
      const mesh = randomFans(random);
      assert.deepEqual(trianglesOf(order(mesh)), trianglesOf(mesh.corners));
    }
  });

  test("reduces fetches from more than one vertex per triangle to less than two thirds", () => {
    const square = squareOf(100);
    assert.ok(missesPerTriangle(square.corners, 16) > 1);
    for (const size of [16, 32]) {
      const misses = missesPerTriangle(order(square), size);
      assert.ok(misses < 0.65, `${misses} in a cache of ${size}`);
    }
  });
});
