// Which shapes are drawn together. A draw costs the page about as much as some
// ten thousand vertices cost the GPU, so a scene of many shapes must not draw them
// one by one: what stands in many places is drawn in all of them at once, and
// small meshes become one large mesh. See docs/decisions/batches.md.

import type { GeometryDescription, ShapeDescription } from "../../document/description.ts";

/** By itself; in all its places at once; or as a part of one mesh with others. */
export type DrawnAs = "alone" | "instanced" | "merged";

/** Scenes of fewer places are drawn one by one, each under its own matrix in double precision. */
export const leastPlaces = 16;
/** In all its places together, what is merged has no more vertices than this. */
export const mostMergedVertices = 16384;

/**
 * How to draw each geometry of these shapes, a shape for each place. All patches of
 * a geometry are drawn alike: their common vertices go through the same arithmetic.
 */
export function planOf(places: readonly ShapeDescription[]): (geometry: GeometryDescription) => DrawnAs {
  const counts = new Map<GeometryDescription, number>();
  for (const { geometry } of places) if (geometry) counts.set(geometry, (counts.get(geometry) ?? 0) + 1);
  const placeCount = Array.from(counts.values()).reduce((sum, count) => sum + count, 0);
  if (placeCount < leastPlaces) return () => "alone";
  return (geometry) => {
    const count = counts.get(geometry) ?? 0;
    if (isColoredByValues(geometry)) return "alone"; // each shape has a map of colours
    if (geometry.container !== "sig" && verticesOf(geometry) * count <= mostMergedVertices) return "merged";
    return count > 1 ? "instanced" : "alone";
  };
}

function isColoredByValues({ value }: GeometryDescription): boolean {
  return value !== undefined;
}

/** Infinity where the document does not tell. */
function verticesOf({ patches }: GeometryDescription): number {
  return patches.reduce((sum, { vertexCount }) => sum + (vertexCount || Infinity), 0);
}
