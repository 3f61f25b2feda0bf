// Triangles in an order in which the GPU finds most of their vertices transformed
// already. They come in fans around the nodes of a boundary, one ring after the
// other, so that a GPU would transform each vertex twice: with the ring inside of
// it, and again with the one outside, since rings are longer than its cache. Drawn
// in columns across several rings it does so for the vertices between columns of
// rings alone.

import type { IndexArray } from "../../stage/vertexArray.ts";

/** Rings that a column crosses: with more of them, columns beside each other no longer meet in a cache of 16 vertices. */
const rings = 4;

/** Corners of triangles into `ordered`, which is as long; `fans` are those of a Connectivity. Each triangle keeps its turn. */
export function orderForVertexCache<Index extends IndexArray>(
  corners: Int32Array,
  fans: Int32Array,
  ordered: Index,
): Index {
  const isDone = new Uint8Array(fans.length / 2);
  // Per ring of the column: the next node, and the end of its nodes.
  const next = new Int32Array(rings);
  const end = new Int32Array(rings);
  let written = 0;
  for (let foot = 0; foot < isDone.length; ++foot) {
    next[0] = foot;
    end[0] = foot + 1;
    for (let ring = 0; ring >= 0;) {
      const node = next[ring]!;
      if (node === end[ring]) {
        --ring;
        continue;
      }
      next[ring] = node + 1;
      if (isDone[node] === 1) continue;
      isDone[node] = 1;
      const first = node > 0 ? 3 * fans[2 * node - 2]! : 0;
      const last = 3 * fans[2 * node]!;
      for (let c = first; c < last; ++c) ordered[written++] = corners[c]!;
      if (ring + 1 === rings) continue;
      ++ring;
      next[ring] = node > 0 ? fans[2 * node - 1]! : 0;
      end[ring] = fans[2 * node + 1]!;
    }
  }
  return ordered;
}
