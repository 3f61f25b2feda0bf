// Bounding boxes and spheres in scene coordinates.

import type { Matrix4 } from "three";
import { Box3, Sphere, Vector3 } from "three";
import type { Vec3 } from "../document/description.ts";

/** GPUs cannot draw beyond this coordinate: squares of lengths must fit into single precision. */
const maxCoordinate = 1e18;

/** Whether a GPU can draw the content of a box. Other boxes are left out of the bounds to which the camera fits. */
export function isDrawable({ min, max }: Box3): boolean {
  const isWithin = ({ x, y, z }: Vector3): boolean =>
    Math.abs(x) < maxCoordinate && Math.abs(y) < maxCoordinate && Math.abs(z) < maxCoordinate;
  return isWithin(min) && isWithin(max);
}

/** The axis-aligned bounds of a transformed box. */
export function transformedBox(sceneFromBox: Matrix4, { min, max }: { min: Vec3; max: Vec3 }): Box3 {
  return new Box3(new Vector3(...min), new Vector3(...max)).applyMatrix4(sceneFromBox);
}

/** The bounds of a box under every rotation about a point. */
export function boxOfAllRotations({ min, max }: Box3, center: Vector3): Box3 {
  const radius = new Vector3().subVectors(max, center).max(new Vector3().subVectors(center, min)).length();
  return new Box3().setFromCenterAndSize(center, new Vector3().setScalar(2 * radius));
}

/** The bounding sphere of a box; the unit sphere for an empty one. */
export function sphereAround(box: Box3): Sphere {
  return box.isEmpty() ? new Sphere(new Vector3(), 1) : box.getBoundingSphere(new Sphere());
}
