// Properties of primitive types.

import type { DrawRange } from "../../stage/stage.ts";

/** Number of vertices per primitive. */
export function cornersOf({ primitive }: Pick<DrawRange, "primitive">): 1 | 2 | 3 {
  return primitive === "points" ? 1 : primitive === "lines" || primitive === "lineStrip" ? 2 : 3;
}

/** Number of triangles of a draw; 0 for points and lines. */
export function triangleCountOf({ primitive, count }: DrawRange): number {
  return primitive === "triangles" ? Math.floor(count / 3) : primitive === "triangleStrip" ? Math.max(0, count - 2) : 0;
}

export function isSurface({ primitive }: Pick<DrawRange, "primitive">): boolean {
  return primitive === "triangles" || primitive === "triangleStrip";
}

export function isLine({ primitive }: Pick<DrawRange, "primitive">): boolean {
  return primitive === "lines" || primitive === "lineStrip";
}
