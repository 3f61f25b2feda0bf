// The error of a group on the screen: where its own sphere is nearest to the eye, or that of a group below where that
// is larger. So errors nest, in and out of the frustum: what exceeds a tolerance is a legal cut. No group is nearer than
// the box of the mesh, out of which the spheres of large groups reach far.

import type { Box, Camera, Matrix, Point } from "../scheduler/viewMetrics.ts";
import { distanceToBox, scaleOf } from "../scheduler/viewMetrics.ts";
import type { LevelIndex } from "./levelIndex.ts";

/** One camera that sees one instance of the mesh. */
export interface LevelView {
  /** `pixelsPerUnit` of an orthographic camera holds at any distance. */
  readonly camera: Camera;
  readonly isOrthographic: boolean;
  /** From lattice steps of the mesh to the camera's coordinates. */
  readonly sceneFromLattice: Matrix;
  /** The bounds of the mesh, in lattice steps. */
  readonly box: Box;
}

/** The largest divisor of errors outside of the frustum. */
const maxDivisor = 100;
/** Errors have the largest divisor where the distance from the frustum is this part of the distance to the eye. */
const fullDivisorAt = 0.5;

/** Gives the error of a group in pixels: Infinity for roots. Groups out of the frustum have up to a hundredth. */
export type ErrorInPixels = (group: number) => number;

/**
 * The largest error in all views, of the group and of those below whose pages are here. To be used while the index does
 * not change.
 */
export function errorInPixels(index: LevelIndex, views: readonly LevelView[]): ErrorInPixels {
  const measures = views.map((view) => errorInView(index, view));
  const largestOf = (group: number, extent: "radius" | "reach"): number => {
    let largest = 0;
    for (const measure of measures) largest = Math.max(largest, measure(group, extent));
    return largest;
  };
  if (index.hasNestedSpheres) return (group) => (group < index.rootCount ? Infinity : largestOf(group, "radius"));
  const known = new Map<number, number>();
  const errorOf = (group: number): number => {
    if (group < index.rootCount) return Infinity;
    let error = known.get(group);
    if (error !== undefined) return error;
    error = largestOf(group, "radius");
    // A group has several times the error of its children: few of them are so much nearer.
    for (const child of index.children(group))
      if (index.has(child) && largestOf(child, "reach") > error) error = Math.max(error, errorOf(child));
    known.set(group, error);
    return error;
  };
  return errorOf;
}

/** Groups whose sphere has a focus in it are refined as if their error were this much larger. */
const focusFactor = 1e6;

/**
 * The errors of `measure`, larger where a point of the scene is in the reach of a group of one of the instances. It
 * contains the reaches of its children, so that what exceeds a tolerance is a legal cut here, too.
 */
export function errorAround(
  measure: ErrorInPixels,
  index: LevelIndex,
  sceneFromLattices: readonly Matrix[],
  [x, y, z]: Point,
): ErrorInPixels {
  const bounds = { x: 0, y: 0, z: 0, radius: 0, reach: 0, error: 0 };
  const along = (m: Matrix, row: number): number =>
    m[row]! * bounds.x + m[4 + row]! * bounds.y + m[8 + row]! * bounds.z + m[12 + row]!;
  return (group) => {
    index.readBounds(group, bounds);
    const isAround = sceneFromLattices.some(
      (m) => Math.hypot(along(m, 0) - x, along(m, 1) - y, along(m, 2) - z) <= scaleOf(m) * bounds.reach,
    );
    return isAround ? focusFactor * Math.max(measure(group), bounds.error) : measure(group);
  };
}

type ErrorInView = (group: number, extent: "radius" | "reach") => number;

function errorInView(index: LevelIndex, { camera, isOrthographic, sceneFromLattice: m, box }: LevelView): ErrorInView {
  const { position, planes, pixelsPerUnit, near } = camera;
  const nearest = Math.max(near, distanceToBox(position, box, m));
  const scale = scaleOf(m);
  const m0 = m[0]!,
    m1 = m[1]!,
    m2 = m[2]!,
    m4 = m[4]!,
    m5 = m[5]!,
    m6 = m[6]!;
  const m8 = m[8]!,
    m9 = m[9]!,
    m10 = m[10]!,
    m12 = m[12]!,
    m13 = m[13]!,
    m14 = m[14]!;
  const [eyeX, eyeY, eyeZ] = position;
  const flatPlanes = Float64Array.from(planes.flat());
  const width = orthographicWidth(planes);
  const bounds = { x: 0, y: 0, z: 0, radius: 0, reach: 0, error: 0 };
  return (group, extent) => {
    index.readBounds(group, bounds);
    const { x, y, z } = bounds;
    const centerX = m0 * x + m4 * y + m8 * z + m12;
    const centerY = m1 * x + m5 * y + m9 * z + m13;
    const centerZ = m2 * x + m6 * y + m10 * z + m14;
    const radius = scale * bounds[extent];
    const pixels = bounds.error * scale * pixelsPerUnit;
    let outside = 0;
    for (let at = 0; at < flatPlanes.length; at += 4) {
      const [a, b] = [flatPlanes[at]! * centerX, flatPlanes[at + 1]! * centerY];
      outside = Math.max(outside, -(a + b + flatPlanes[at + 2]! * centerZ + flatPlanes[at + 3]!) - radius);
    }
    if (isOrthographic) return pixels / (1 + (maxDivisor - 1) * Math.min(1, outside / (fullDivisorAt * width)));
    // Math.hypot takes several times as long.
    const toCenter = Math.sqrt((centerX - eyeX) ** 2 + (centerY - eyeY) ** 2 + (centerZ - eyeZ) ** 2);
    const distance = Math.max(toCenter - radius, nearest);
    // Both terms grow with the distance and with `outside`, so that a sphere inside another has no smaller divisor.
    return pixels / (distance + (maxDivisor - 1) * Math.min(distance, outside / fullDivisorAt));
  };
}

/** The distance of the first two planes, which are the two sides of the view of an orthographic camera. */
function orthographicWidth(planes: Camera["planes"]): number {
  const width = (planes[0]?.[3] ?? 0) + (planes[1]?.[3] ?? 0);
  return width > 0 ? width : 1;
}
