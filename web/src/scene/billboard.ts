// The rotation of X3D billboards (ISO/IEC 19775-1, 23.4.1), groups that face the viewer.

import { Matrix4, Quaternion, Vector3 } from "three";
import type { Vec3 } from "../document/description.ts";

/** Directions at a smaller angle count as parallel: no rotation is defined for them. */
const minSine = 1e-6;

/**
 * The rotation about `axis` that turns a billboard to the viewer. If the axis is 0 0 0, the billboard turns freely and
 * stays upright on the screen. `eye` is the viewer's position and `up` the screen's up direction, both in the
 * billboard's coordinates.
 */
export function billboardRotation(axis: Vec3, eye: Vector3, up: Vector3): Matrix4 {
  const rotation = new Matrix4();
  if (eye.length() === 0) return rotation;
  const toEye = eye.clone().normalize();
  const direction = new Vector3(...axis);
  if (direction.length() > 0) return rotation.makeRotationFromQuaternion(rotationAbout(direction.normalize(), toEye));
  const right = up.clone().cross(toEye);
  if (right.length() < minSine * up.length()) return rotation;
  right.normalize();
  return rotation.makeBasis(right, toEye.clone().cross(right), toEye);
}

/** The rotation about `axis` that brings the z axis into the plane of the axis and the viewer. */
function rotationAbout(axis: Vector3, toEye: Vector3): Quaternion {
  const rotation = new Quaternion();
  const [from, to] = [new Vector3(0, 0, 1), toEye].map((vector) => vector.projectOnPlane(axis));
  if (from === undefined || to === undefined || from.length() < minSine || to.length() < minSine) return rotation;
  return rotation.setFromAxisAngle(axis, Math.atan2(axis.dot(from.clone().cross(to)), from.dot(to)));
}
