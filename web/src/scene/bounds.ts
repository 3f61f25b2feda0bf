// Bounding boxes and spheres in scene coordinates.

import type { Matrix4 } from "three";
import { Box3, Sphere, Vector3 } from "three";
import type { Vec3 } from "../document/description.ts";

/** Lengths whose squares single precision still holds: beyond, no GPU draws anything, and the rest must be seen. */
const farthest = 1e18;

export function isDrawable({ min, max }: Box3): boolean {
  return [...min.toArray(), ...max.toArray()].every((edge) => Math.abs(edge) < farthest);
}

export function transformedBox(sceneFromBox: Matrix4, { min, max }: { min: Vec3; max: Vec3 }): Box3 {
  return new Box3(new Vector3(...min), new Vector3(...max)).applyMatrix4(sceneFromBox);
}

/** Around all that a box comes to as it turns about a point. */
export function boxOfAllRotations({ min, max }: Box3, about: Vector3): Box3 {
  const farthest = new Vector3().subVectors(max, about).max(new Vector3().subVectors(about, min)).length();
  return new Box3().setFromCenterAndSize(about, new Vector3().setScalar(2 * farthest));
}

export function sphereAround(box: Box3): Sphere {
  return box.isEmpty() ? new Sphere(new Vector3(), 1) : box.getBoundingSphere(new Sphere());
}
