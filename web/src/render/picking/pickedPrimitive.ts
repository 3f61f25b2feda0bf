// Finds the primitive that was hit. Of an indexed primitive, the picking pass knows only the last
// vertex and the hit point; of the few primitives that end in this vertex, the one nearest to the
// point was hit.

import { Vector3 } from "three";
import type { IndexArray } from "../../stage/vertexArray.ts";
import type { DrawRange } from "../../stage/stage.ts";

export interface PickedPrimitive {
  /** Index of the primitive in its draw. */
  readonly number: number;
  /** Indices of its vertices, in order. */
  readonly vertices: readonly number[];
}

/** The position of the vertex with this index. */
export type PositionOf = (vertex: number) => Vector3;

/** The primitive that ends in vertex `last` and is nearest to `point`; undefined if none ends in it. */
export function primitiveIn(
  index: IndexArray,
  primitive: DrawRange["primitive"],
  last: number,
  point: Vector3,
  positionOf: PositionOf,
): PickedPrimitive | undefined {
  const { corners, step } = cornersAndStepOf(primitive);
  let found: PickedPrimitive | undefined;
  let minDistance = Infinity;
  for (let at = corners - 1; at < index.length; at += step) {
    if (index[at] !== last) continue;
    const vertices = Array.from(index.subarray(at - corners + 1, at + 1));
    const distance = distanceTo(vertices.map(positionOf), point);
    if (distance >= minDistance) continue;
    minDistance = distance;
    found = { number: (at - corners + 1) / step, vertices };
  }
  return found;
}

/** The primitive whose last corner is element `last` of a draw without an index. */
export function primitiveEndingAt(last: number, range: DrawRange): PickedPrimitive {
  const { corners, step } = cornersAndStepOf(range.primitive);
  return primitiveAt((last - corners + 1) / step, range, undefined);
}

/** The primitive with this number; `index` is the index buffer of the draw, if it has one. */
export function primitiveAt(
  number: number,
  { primitive, first }: DrawRange,
  index: IndexArray | undefined,
): PickedPrimitive {
  const { corners, step } = cornersAndStepOf(primitive);
  const vertexAt = (corner: number) => (index ? (index[number * step + corner] ?? 0) : first + number * step + corner);
  return { number, vertices: Array.from({ length: corners }, (_, corner) => vertexAt(corner)) };
}

/** Corners per primitive, and the number of elements from the start of one primitive to the next. */
function cornersAndStepOf(primitive: DrawRange["primitive"]): { corners: number; step: number } {
  switch (primitive) {
    case "points":
      return { corners: 1, step: 1 };
    case "lines":
      return { corners: 2, step: 2 };
    case "lineStrip":
      return { corners: 2, step: 1 };
    case "triangles":
      return { corners: 3, step: 3 };
    case "triangleStrip":
      return { corners: 3, step: 1 };
  }
}

/** The vertex with the largest barycentric coordinate at the point. */
export function nearestVertex(vertices: readonly number[], point: Vector3, positionOf: PositionOf): number {
  const weights = barycentricCoordinates(vertices.map(positionOf), point) ?? [1];
  return vertices[weights.indexOf(Math.max(...weights))] ?? 0;
}

/**
 * The plane of a face: one of its points, and a normal of any length; zero for points, lines and degenerate triangles.
 */
export interface Face {
  readonly point: Vector3;
  readonly normal: Vector3;
}

export function faceOf(vertices: readonly number[], positionOf: PositionOf): Face {
  const [a = new Vector3(), b, c] = vertices.map(positionOf);
  const normal = b === undefined || c === undefined ? new Vector3() : b.clone().sub(a).cross(c.clone().sub(a));
  return { point: a, normal };
}

// three.js' Triangle and Line3 are not used: each page would load them for these few lines.

function distanceTo(corners: readonly Vector3[], point: Vector3): number {
  const [a, b, c] = corners;
  if (a === undefined || b === undefined) return Infinity;
  const weights = barycentricCoordinates(corners, point);
  if (weights?.every((weight) => weight >= 0)) {
    const nearest = new Vector3();
    corners.forEach((corner, at) => nearest.addScaledVector(corner, weights[at] ?? 0));
    return nearest.distanceTo(point);
  }
  if (c === undefined) return Infinity;
  // Beside a triangle, and of one without area, the nearest point is on an edge.
  return Math.min(distanceTo([a, b], point), distanceTo([b, c], point), distanceTo([c, a], point));
}

/**
 * Weights of the corners: for the nearest point of a line, or for the projection of the point to the plane of a
 * triangle; undefined for a triangle without area.
 */
function barycentricCoordinates([a, b, c]: readonly Vector3[], point: Vector3): readonly number[] | undefined {
  if (a === undefined || b === undefined) return [1];
  const [first, offset] = [b.clone().sub(a), point.clone().sub(a)];
  const [length, along] = [first.dot(first), first.dot(offset)];
  if (c === undefined) {
    const share = length > 0 ? Math.min(Math.max(along / length, 0), 1) : 0;
    return [1 - share, share];
  }
  const second = c.clone().sub(a);
  const [mixed, otherLength, otherAlong] = [first.dot(second), second.dot(second), second.dot(offset)];
  const determinant = length * otherLength - mixed * mixed;
  if (determinant === 0) return undefined;
  const v = (otherLength * along - mixed * otherAlong) / determinant;
  const w = (length * otherAlong - mixed * along) / determinant;
  return [1 - v - w, v, w];
}
