// Orders triangles so that the GPU finds most of their vertices in its cache of transformed vertices. Triangles are
// decoded in fans around the nodes of a boundary, ring by ring. In that order the GPU would transform each vertex
// twice: for the ring inside of it and for the ring outside, since rings are longer than the cache. Drawn in columns
// that cross several rings, only the vertices between two columns are transformed twice.

import type { IndexArray } from "../../stage/vertexArray.ts";

/** Number of rings that a column crosses. With more rings, neighbouring columns share no vertices in a cache of 16. */
const ringCount = 4;

/**
 * Writes the corners of all triangles to `ordered`, which has the same length, and returns it. `fans` are those of a
 * Connectivity. Each triangle keeps the order of its corners.
 */
export function orderForVertexCache<Index extends IndexArray>(
  corners: Int32Array,
  fans: Int32Array,
  ordered: Index,
): Index {
  const isDone = new Uint8Array(fans.length / 2);
  // Per ring of the column: the next node, and the end of the range of nodes.
  const next = new Int32Array(ringCount);
  const end = new Int32Array(ringCount);
  let written = 0;
  for (let columnStart = 0; columnStart < isDone.length; ++columnStart) {
    next[0] = columnStart;
    end[0] = columnStart + 1;
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
      if (ring + 1 === ringCount) continue;
      ++ring;
      next[ring] = node > 0 ? fans[2 * node - 1]! : 0;
      end[ring] = fans[2 * node + 1]!;
    }
  }
  return ordered;
}
