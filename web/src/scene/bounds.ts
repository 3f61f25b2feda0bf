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
  // A row of the matrix takes its minimum at the corner that has the smaller product along each axis.
  const { 0: lowX, 1: lowY, 2: lowZ } = box.min;
  const { 0: highX, 1: highY, 2: highZ } = box.max;
  const { min, max } = target;
  const { 0: m0, 1: m1, 2: m2, 4: m4, 5: m5, 6: m6, 8: m8, 9: m9, 10: m10 } = m;
  min.x = m[12] + productBySign(m0, lowX, highX) + productBySign(m4, lowY, highY) + productBySign(m8, lowZ, highZ);
  max.x = m[12] + productBySign(m0, highX, lowX) + productBySign(m4, highY, lowY) + productBySign(m8, highZ, lowZ);
  min.y = m[13] + productBySign(m1, lowX, highX) + productBySign(m5, lowY, highY) + productBySign(m9, lowZ, highZ);
  max.y = m[13] + productBySign(m1, highX, lowX) + productBySign(m5, highY, lowY) + productBySign(m9, highZ, lowZ);
  min.z = m[14] + productBySign(m2, lowX, highX) + productBySign(m6, lowY, highY) + productBySign(m10, lowZ, highZ);
  max.z = m[14] + productBySign(m2, highX, lowX) + productBySign(m6, highY, lowY) + productBySign(m10, highZ, lowZ);
  return target;
}

/** A factor times one of two numbers: the first where the factor is not negative, otherwise the second. */
function productBySign(factor: number, ifPositive: number, ifNegative: number): number {
  return factor * (factor >= 0 ? ifPositive : ifNegative);
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
