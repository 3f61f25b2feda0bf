// Converts triangle strips to separate triangles: three.js draws the buffers of a Mesh as separate triangles.

import type { IndexArray } from "../stage/vertexArray.ts";
import type { DrawRange } from "../stage/stage.ts";

/**
 * The triangles of a strip, in its orientation. Degenerate triangles stay, so that triangle t of the strip is triangle
 * t of the result; GPUs skip them.
 */
export function trianglesFromStrip(strip: IndexArray): IndexArray {
  const count = Math.max(0, strip.length - 2);
  const triangles = new (strip.constructor as new (length: number) => IndexArray)(count * 3);
  for (let n = 0; n < count; ++n) {
    triangles[3 * n] = strip[n + (n & 1)] ?? 0;
    triangles[3 * n + 1] = strip[n + 1 - (n & 1)] ?? 0;
    triangles[3 * n + 2] = strip[n + 2] ?? 0;
  }
  return triangles;
}

/**
 * The same draws with every strip converted to triangles, and the index that they use. Without strips, `index` and
 * `draws` are returned as they are.
 */
export function withoutStrips<Index extends IndexArray | undefined>(
  index: Index,
  draws: readonly DrawRange[],
): { index: Index | IndexArray; draws: readonly DrawRange[] } {
  if (!draws.some((draw) => draw.primitive === "triangleStrip")) return { index, draws };
  const indexRanges: IndexArray[] = [];
  let first = 0;
  const separate = draws.map((draw): DrawRange => {
    const indices =
      index?.subarray(draw.first, draw.first + draw.count) ??
      Uint32Array.from({ length: draw.count }, (_, n) => draw.first + n);
    const isStrip = draw.primitive === "triangleStrip";
    const converted = isStrip ? trianglesFromStrip(indices) : indices;
    indexRanges.push(converted);
    const range = { primitive: isStrip ? ("triangles" as const) : draw.primitive, first, count: converted.length };
    first += converted.length;
    return range;
  });
  const joined = new Uint32Array(first);
  separate.forEach((draw, drawIndex) => {
    joined.set(indexRanges[drawIndex] ?? [], draw.first);
  });
  return { index: joined, draws: separate };
}
