// Bounding boxes and spheres in scene coordinates.

import type { Box3, Matrix4 } from "three";
import { Sphere, Vector3 } from "three";
import type { Vec3 } from "../document/description.ts";
import {
  flatBoxOf,
  isDrawable as isFlatDrawable,
  makeFlatBox,
  setBox3,
  setFlatBox,
  setTransformed,
} from "./flatBox.ts";

const flat = makeFlatBox();

/** Whether a GPU can draw the content of a box. Other boxes are left out of the bounds to which the camera fits. */
export function isDrawable(box: Box3): boolean {
  return isFlatDrawable(setFlatBox(flat, box));
}

/** Sets `target` to the axis-aligned bounds of a transformed box. */
export function setTransformedBox(
  target: Box3,
  sceneFromBox: Matrix4,
  box: { readonly min: Vec3; readonly max: Vec3 },
): Box3 {
  setTransformed(flat, sceneFromBox, flatBoxOf(box));
  return setBox3(target, flat);
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
