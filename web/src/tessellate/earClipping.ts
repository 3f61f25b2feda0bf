// Triangulates polygons by ear clipping. An ear is a convex corner whose triangle contains no other corner (Meisters,
// "Polygons have ears", 1975), and only reflex corners can lie in it (Eberly, "Triangulation by ear clipping", 2002).
// triangulate() in src/import cuts the same triangles: vectors/tessellation/earClipping.json tests both.

import type { Vec3 } from "./vectors.ts";
import { cross, minus } from "./vectors.ts";

type Point = readonly [number, number];

/** Polygons with more corners become fans: clipping takes time quadratic in the number of corners. */
const maxCorners = 512;

/**
 * Cuts a polygon of n corners into n - 2 triangles and returns their corners as indices into `ring`, three for each
 * triangle. A convex polygon becomes a fan about its first corner, and so does one without area. Polygons that cross
 * themselves still give n - 2 triangles.
 */
export function triangulate(ring: readonly Vec3[]): number[] {
  const normal = doubleVectorArea(ring);
  if (ring.length <= 3 || normal.every((component) => component === 0)) return fan(ring.length);
  const polygon = projected(ring, normal);
  return isConvex(polygon) || ring.length > maxCorners ? fan(ring.length) : clipEars(polygon);
}

function fan(cornerCount: number): number[] {
  return Array.from({ length: Math.max(cornerCount - 2, 0) }, (_, i) => [0, i + 1, i + 2]).flat();
}

/**
 * Twice the polygon's vector area, which points along its normal. Computed relative to the first corner, which keeps
 * the precision of distant polygons.
 */
function doubleVectorArea([first = [0, 0, 0], ...others]: readonly Vec3[]): Vec3 {
  let sum: Vec3 = [0, 0, 0];
  for (const [i, corner] of others.slice(0, -1).entries()) {
    const [x, y, z] = cross(minus(corner, first), minus(others[i + 1] ?? corner, first));
    sum = [sum[0] + x, sum[1] + y, sum[2] + z];
  }
  return sum;
}

/** Projects the polygon along the axis nearest to its normal, so that it runs counter-clockwise. */
function projected(ring: readonly Vec3[], normal: Vec3): Point[] {
  let axis: 0 | 1 | 2 = 0;
  for (const other of [1, 2] as const) if (Math.abs(normal[other]) > Math.abs(normal[axis])) axis = other;
  const [u, v] = [((axis + 1) % 3) as 0 | 1 | 2, ((axis + 2) % 3) as 0 | 1 | 2];
  const isFlipped = normal[axis] < 0;
  return ring.map((point) => (isFlipped ? [point[v], point[u]] : [point[u], point[v]]));
}

/** Twice the signed area of a triangle. */
function doubleArea(a: Point, b: Point, c: Point): number {
  return (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
}

const origin: Point = [0, 0];

function isConvex(polygon: readonly Point[]): boolean {
  const pointAt = (i: number) => polygon[i % polygon.length] ?? origin;
  return polygon.every(
    (point, i) =>
      doubleArea(point, pointAt(i + 1), pointAt(i + 2)) >= 0 &&
      // A pentagram turns in the same direction at every corner, too; its fan about the first corner has flipped
      // triangles.
      (i === 0 || i + 1 >= polygon.length || doubleArea(pointAt(0), point, pointAt(i + 1)) >= 0),
  );
}

function clipEars(polygon: readonly Point[]): number[] {
  const remaining = polygon.map((_, corner) => corner);
  const triangles: number[] = [];
  const cornerAt = (index: number) => remaining[index % remaining.length] ?? 0;
  const pointAt = (index: number) => polygon[cornerAt(index)] ?? origin;
  const doubleAreaAt = (index: number) =>
    doubleArea(pointAt(index + remaining.length - 1), pointAt(index), pointAt(index + 1));
  const isEar = (index: number): boolean => {
    if (doubleAreaAt(index) <= 0) return false;
    const [a, b, c] = [pointAt(index + remaining.length - 1), pointAt(index), pointAt(index + 1)];
    for (let other = index + 2; other < index + remaining.length - 1; ++other) {
      const p = pointAt(other);
      // A polygon with a bridge to a hole passes through the bridge's ends twice.
      if ([a, b, c].some((q) => q[0] === p[0] && q[1] === p[1]) || doubleAreaAt(other) > 0) continue;
      if (doubleArea(a, b, p) >= 0 && doubleArea(b, c, p) >= 0 && doubleArea(c, a, p) >= 0) return false;
    }
    return true;
  };
  for (let index = 0, rejectedCount = 0; remaining.length > 2;) {
    // A polygon that crosses itself may have no ear: then any corner is cut off.
    if (rejectedCount < remaining.length && !isEar(index)) {
      index = (index + 1) % remaining.length;
      ++rejectedCount;
      continue;
    }
    triangles.push(cornerAt(index + remaining.length - 1), cornerAt(index), cornerAt(index + 1));
    remaining.splice(index, 1);
    index = (index + 1) % remaining.length; // skips a corner: clipping neighbours in turn would make needles
    rejectedCount = 0;
  }
  return triangles;
}
