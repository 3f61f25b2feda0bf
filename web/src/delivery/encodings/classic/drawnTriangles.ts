// The triangles of a patch, as normals are computed from them.

import type { DrawRange } from "../../../stage/stage.ts";
import type { IndexArray } from "../../../stage/vertexArray.ts";

/**
 * The corners of the triangles of all draws one after the other, without corners that complete none. Undefined where
 * other primitives are drawn, too.
 */
export function drawnTriangles(index: IndexArray, draws: readonly DrawRange[]): IndexArray | undefined {
  if (draws.some(({ primitive }) => primitive !== "triangles")) return undefined;
  if (draws.every(({ count }) => count % 3 === 0)) return index;
  const triangles = draws.map(({ first, count }) => index.subarray(first, first + count - (count % 3)));
  const all = new Uint32Array(triangles.reduce((sum, { length }) => sum + length, 0));
  let at = 0;
  for (const corners of triangles) {
    all.set(corners, at);
    at += corners.length;
  }
  return all;
}
