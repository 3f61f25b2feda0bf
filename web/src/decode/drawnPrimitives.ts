// Converts the primitives that documents name to those that the renderer draws: three.js draws the buffers of a Mesh as
// separate triangles whose front is counterclockwise, and has no loops.

import type { IndexArray } from "../stage/vertexArray.ts";
import type { DrawRange, StatedDrawRange } from "../stage/stage.ts";

/** Corners of the triangles of a strip or a fan, for each triangle, from the first corner of all. */
type TriangleCorners = (triangle: number) => readonly [number, number, number];

/** In the strip's orientation: every other triangle has two corners exchanged. */
const stripCorners: TriangleCorners = (n) => [n + (n & 1), n + 1 - (n & 1), n + 2];
const fanCorners: TriangleCorners = (n) => [0, n + 1, n + 2];

/**
 * The triangles of a strip or a fan, in its orientation. Degenerate triangles stay, so that triangle t of the strip is
 * triangle t of the result; GPUs skip them.
 */
function separateTriangles(indices: IndexArray, cornersOf: TriangleCorners): IndexArray {
  const count = Math.max(0, indices.length - 2);
  const triangles = arrayLike(indices, count * 3);
  for (let n = 0; n < count; ++n) {
    const [a, b, c] = cornersOf(n);
    triangles[3 * n] = indices[a] ?? 0;
    triangles[3 * n + 1] = indices[b] ?? 0;
    triangles[3 * n + 2] = indices[c] ?? 0;
  }
  return triangles;
}

export function trianglesFromStrip(strip: IndexArray): IndexArray {
  return separateTriangles(strip, stripCorners);
}

/** The same triangles with the other side as their front. */
function reversedTriangles(triangles: IndexArray): IndexArray {
  const reversed = triangles.slice();
  for (let corner = 0; corner + 2 < triangles.length; corner += 3) {
    reversed[corner + 1] = triangles[corner + 2] ?? 0;
    reversed[corner + 2] = triangles[corner + 1] ?? 0;
  }
  return reversed;
}

/** The line strip that draws a loop: it ends where it begins. */
function closedStrip(loop: IndexArray): IndexArray {
  if (loop.length < 2) return loop.subarray(0, 0);
  const strip = arrayLike(loop, loop.length + 1);
  strip.set(loop);
  strip[loop.length] = loop[0] ?? 0;
  return strip;
}

function arrayLike(indices: IndexArray, length: number): IndexArray {
  return new (indices.constructor as new (length: number) => IndexArray)(length);
}

/** A draw of one primitive as the primitive that is drawn for it. */
function drawnAs(
  primitive: StatedDrawRange["primitive"],
  indices: IndexArray,
): { primitive: DrawRange["primitive"]; indices: IndexArray } {
  switch (primitive) {
    case "triangleStrip":
      return { primitive: "triangles", indices: trianglesFromStrip(indices) };
    case "triangleFan":
      return { primitive: "triangles", indices: separateTriangles(indices, fanCorners) };
    case "lineLoop":
      return { primitive: "lineStrip", indices: closedStrip(indices) };
    default:
      return { primitive, indices };
  }
}

/** Whether the renderer draws buffers of this primitive as they are. */
function isDrawnAsStated(draw: StatedDrawRange, ccw: boolean): draw is DrawRange {
  if (draw.primitive === "triangles") return ccw;
  return draw.primitive === "points" || draw.primitive === "lines" || draw.primitive === "lineStrip";
}

/**
 * Draws that the renderer has, and the index that they use. Where it has the stated ones, `index` and `draws` are
 * returned as they are. `ccw`: the front of the stated triangles is counterclockwise.
 */
export function drawnPrimitives<Index extends IndexArray | undefined>(
  index: Index,
  draws: readonly StatedDrawRange[],
  ccw: boolean,
): { index: Index | IndexArray; draws: readonly DrawRange[] } {
  const drawn = draws.filter((draw) => isDrawnAsStated(draw, ccw));
  if (drawn.length === draws.length) return { index, draws: drawn };
  const indexRanges: IndexArray[] = [];
  let first = 0;
  const separate = draws.map((draw): DrawRange => {
    const stated =
      index?.subarray(draw.first, draw.first + draw.count) ??
      Uint32Array.from({ length: draw.count }, (_, n) => draw.first + n);
    const { primitive, indices } = drawnAs(draw.primitive, stated);
    const oriented = primitive === "triangles" && !ccw ? reversedTriangles(indices) : indices;
    indexRanges.push(oriented);
    const range = { primitive, first, count: oriented.length };
    first += oriented.length;
    return range;
  });
  const joined = new Uint32Array(first);
  separate.forEach((draw, drawIndex) => {
    joined.set(indexRanges[drawIndex] ?? [], draw.first);
  });
  return { index: joined, draws: separate };
}
