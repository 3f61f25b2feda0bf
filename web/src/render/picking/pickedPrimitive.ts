// Which primitive of an index was hit. Of an indexed primitive the picking pass
// knows its last vertex and the point; a handful of primitives end in that
// vertex, and the one that the point lies on is it.

import { Line3, Triangle, Vector3 } from "three";
import type { IndexArray } from "../../stage/vertexArray.ts";
import type { DrawRange } from "../../stage/stage.ts";

export interface PickedPrimitive {
  /** Which one of the index, counted from 0. */
  readonly number: number;
  /** The vertices of its corners, in their order. */
  readonly vertices: readonly number[];
}

/** Where vertex number n lies. */
export type PositionOf = (vertex: number) => Vector3;

/**
 * Among the primitives of the index, the one that ends in the vertex `last` and
 * is nearest to `point`; undefined where none ends in it.
 */
export function primitiveIn(
  index: IndexArray,
  primitive: DrawRange["primitive"],
  last: number,
  point: Vector3,
  positionOf: PositionOf,
): PickedPrimitive | undefined {
  const { corners, step } = layoutOf(primitive);
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

/** The primitive whose last corner is number `last` of a range without an index. */
export function primitiveEndingAt(last: number, range: DrawRange): PickedPrimitive {
  const { corners, step } = layoutOf(range.primitive);
  return primitiveAt((last - corners + 1) / step, range, undefined);
}

/** The primitive of this number. `index`: of the range, where there is one. */
export function primitiveAt(
  number: number,
  { primitive, first }: DrawRange,
  index: IndexArray | undefined,
): PickedPrimitive {
  const { corners, step } = layoutOf(primitive);
  const vertexAt = (corner: number) => (index ? (index[number * step + corner] ?? 0) : first + number * step + corner);
  return { number, vertices: Array.from({ length: corners }, (_, corner) => vertexAt(corner)) };
}

/** Corners of a primitive, and how many elements on the next one ends. */
function layoutOf(primitive: DrawRange["primitive"]): { corners: number; step: number } {
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

/** The vertex whose corner has the largest share in the point. */
export function nearestVertex(vertices: readonly number[], point: Vector3, positionOf: PositionOf): number {
  const shares = sharesOf(vertices.map(positionOf), point);
  return vertices[shares.indexOf(Math.max(...shares))] ?? 0;
}

/** The plane of a face: a point of it, and what stands on it at right angles, of any length; zero where there is no face. */
export interface Face {
  readonly point: Vector3;
  readonly normal: Vector3;
}

export function faceOf(vertices: readonly number[], positionOf: PositionOf): Face {
  const [a = new Vector3(), b, c] = vertices.map(positionOf);
  const normal = b === undefined || c === undefined ? new Vector3() : b.clone().sub(a).cross(c.clone().sub(a));
  return { point: a, normal };
}

function distanceTo(corners: readonly Vector3[], point: Vector3): number {
  const [a, b, c] = corners;
  if (a === undefined || b === undefined) return Infinity;
  const nearest =
    c === undefined
      ? new Line3(a, b).closestPointToPoint(point, true, new Vector3())
      : new Triangle(a, b, c).closestPointToPoint(point, new Vector3());
  return nearest.distanceTo(point);
}

function sharesOf(corners: readonly Vector3[], point: Vector3): number[] {
  const [a, b, c] = corners;
  if (a === undefined || b === undefined) return [1];
  if (c === undefined) {
    const along = new Line3(a, b).closestPointToPointParameter(point, true);
    return [1 - along, along];
  }
  return new Triangle(a, b, c).getBarycoord(point, new Vector3())?.toArray() ?? [1];
}
