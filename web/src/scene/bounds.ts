// Bounding boxes and spheres in scene coordinates.

import type { Box3, Matrix4 } from "three";
import { Sphere, Vector3 } from "three";
import type { Vec3 } from "../document/description.ts";

/** GPUs cannot draw beyond this coordinate: squares of lengths must fit into single precision. */
const maxCoordinate = 1e18;

/** Whether a GPU can draw the content of a box. Other boxes are left out of the bounds to which the camera fits. */
export function isDrawable({ min, max }: Box3): boolean {
  return isWithinReach(min) && isWithinReach(max);
}

function isWithinReach({ x, y, z }: Vector3): boolean {
  return Math.abs(x) < maxCoordinate && Math.abs(y) < maxCoordinate && Math.abs(z) < maxCoordinate;
}

/** Sets `target` to the axis-aligned bounds of a transformed box. */
export function setTransformedBox(
  target: Box3,
  { elements: m }: Matrix4,
  box: { readonly min: Vec3; readonly max: Vec3 },
): Box3 {
  // A row of the matrix takes its least value at the corner that has the lesser product along each axis.
  const { 0: lowX, 1: lowY, 2: lowZ } = box.min;
  const { 0: highX, 1: highY, 2: highZ } = box.max;
  const { min, max } = target;
  const { 0: m0, 1: m1, 2: m2, 4: m4, 5: m5, 6: m6, 8: m8, 9: m9, 10: m10 } = m;
  min.x = m[12] + minProduct(m0, lowX, highX) + minProduct(m4, lowY, highY) + minProduct(m8, lowZ, highZ);
  max.x = m[12] + minProduct(m0, highX, lowX) + minProduct(m4, highY, lowY) + minProduct(m8, highZ, lowZ);
  min.y = m[13] + minProduct(m1, lowX, highX) + minProduct(m5, lowY, highY) + minProduct(m9, lowZ, highZ);
  max.y = m[13] + minProduct(m1, highX, lowX) + minProduct(m5, highY, lowY) + minProduct(m9, highZ, lowZ);
  min.z = m[14] + minProduct(m2, lowX, highX) + minProduct(m6, lowY, highY) + minProduct(m10, lowZ, highZ);
  max.z = m[14] + minProduct(m2, highX, lowX) + minProduct(m6, highY, lowY) + minProduct(m10, highZ, lowZ);
  return target;
}

/** The minimum of a factor times a number from `low` to `high`; the maximum where these two are exchanged. */
function minProduct(factor: number, low: number, high: number): number {
  return factor * (factor >= 0 ? low : high);
}

/** Extends a box to its bounds under every rotation about a point. */
export function unionOfAllRotations(box: Box3, center: Vector3): void {
  const radius = new Vector3().subVectors(box.max, center).max(new Vector3().subVectors(center, box.min)).length();
  box.setFromCenterAndSize(center, new Vector3().setScalar(2 * radius));
}

/** The bounding sphere of a box; the unit sphere for an empty one. */
export function sphereAround(box: Box3): Sphere {
  return box.isEmpty() ? new Sphere(new Vector3(), 1) : box.getBoundingSphere(new Sphere());
}
