// Billboards (ISO/IEC 19775-1, 23.4.1): groups that turn to the viewer.

import { Matrix4, Quaternion, Vector3 } from "three";
import type { Vec3 } from "../document/description.ts";

/** Below, two directions are one, and there is no telling where to turn. */
const leastSine = 1e-6;

/**
 * How a billboard turns, in the coordinates of the group around it. `eye` is the
 * viewer's place there, `up` the direction that is up in the picture.
 */
export function billboardRotation(axis: Vec3, eye: Vector3, up: Vector3): Matrix4 {
  const turn = new Matrix4();
  if (eye.length() === 0) return turn;
  const toEye = eye.clone().normalize();
  const about = new Vector3(...axis);
  if (about.length() > 0) return turn.makeRotationFromQuaternion(turnAbout(about.normalize(), toEye));
  const right = up.clone().cross(toEye);
  if (right.length() < leastSine * up.length()) return turn;
  right.normalize();
  return turn.makeBasis(right, toEye.clone().cross(right), toEye);
}

/** The z axis comes into the plane of the axis and the viewer. */
function turnAbout(axis: Vector3, toEye: Vector3): Quaternion {
  const turn = new Quaternion();
  const [from, to] = [new Vector3(0, 0, 1), toEye].map((direction) => direction.projectOnPlane(axis));
  if (from === undefined || to === undefined || from.length() < leastSine || to.length() < leastSine) return turn;
  return turn.setFromAxisAngle(axis, Math.atan2(axis.dot(from.clone().cross(to)), from.dot(to)));
}
