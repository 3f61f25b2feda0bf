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
  let [minX, minY, minZ, maxX, maxY, maxZ] = [m[12], m[13], m[14], m[12], m[13], m[14]];
  for (let axis = 0; axis < 3; ++axis) {
    const [low, high] = [box.min[axis] ?? 0, box.max[axis] ?? 0];
    const [x, y, z] = [m[4 * axis] ?? 0, m[4 * axis + 1] ?? 0, m[4 * axis + 2] ?? 0];
    minX += Math.min(x * low, x * high);
    maxX += Math.max(x * low, x * high);
    minY += Math.min(y * low, y * high);
    maxY += Math.max(y * low, y * high);
    minZ += Math.min(z * low, z * high);
    maxZ += Math.max(z * low, z * high);
  }
  target.min.set(minX, minY, minZ);
  target.max.set(maxX, maxY, maxZ);
  return target;
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
