// Triangle strips as separate triangles: buffers of three.js are drawn as
// triangles only.

import type { IndexArray } from "../stage/vertexArray.ts";
import type { DrawRange } from "../stage/stage.ts";

/**
 * A strip's triangles in its orientation. Degenerate joins stay, so that the
 * strip's triangle t is triangle t; GPUs pass over them.
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

/** The same draws with every strip turned into triangles behind an index of their own. */
export function withoutStrips<Index extends IndexArray | undefined>(
  index: Index,
  draws: readonly DrawRange[],
): { index: Index | IndexArray; draws: readonly DrawRange[] } {
  if (!draws.some((draw) => draw.primitive === "triangleStrip")) return { index, draws };
  const parts: IndexArray[] = [];
  let first = 0;
  const separate = draws.map((draw): DrawRange => {
    const numbers =
      index?.subarray(draw.first, draw.first + draw.count) ??
      Uint32Array.from({ length: draw.count }, (_, n) => draw.first + n);
    const isStrip = draw.primitive === "triangleStrip";
    const part = isStrip ? trianglesFromStrip(numbers) : numbers;
    parts.push(part);
    const range = { primitive: isStrip ? ("triangles" as const) : draw.primitive, first, count: part.length };
    first += part.length;
    return range;
  });
  const joined = new Uint32Array(first);
  separate.forEach((draw, place) => {
    joined.set(parts[place] ?? [], draw.first);
  });
  return { index: joined, draws: separate };
}
