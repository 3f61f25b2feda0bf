// Animated transitions from one camera pose to another. They interpolate the center of rotation, the orientation, and
// the offset from the center to the eye in the camera's own axes. A camera that goes to the other side of a statue
// therefore keeps its distance instead of flying through it.

import { MathUtils } from "three";
import type { Pose } from "./cameraPose.ts";

/** `t` is 0 … 1; 0 gives exactly `from` and 1 exactly `to`. */
export function interpolatePose(from: Pose, to: Pose, t: number): Pose {
  if (t <= 0) return from;
  if (t >= 1) return to;
  const orientation = from.orientation.clone().slerp(to.orientation, t);
  const center = from.center.clone().lerp(to.center, t);
  const [startOffset, endOffset] = [eyeOffsetOf(from), eyeOffsetOf(to)];
  // Interpolated geometrically, so that zooming looks even.
  const distance = startOffset.length() * (endOffset.length() / (startOffset.length() || 1)) ** t;
  const direction = startOffset.clone().lerp(endOffset, t);
  const isDirected =
    direction.length() > 1e-3 * Math.max(startOffset.length(), endOffset.length()) &&
    startOffset.length() > 0 &&
    endOffset.length() > 0;
  const eyeOffset = isDirected ? direction.setLength(distance) : direction;
  return {
    position: center.clone().add(eyeOffset.applyQuaternion(orientation)),
    orientation,
    center,
    up: from.up.clone().lerp(to.up, t).normalize(),
    fieldOfView: MathUtils.lerp(from.fieldOfView, to.fieldOfView, t),
    aspectRatio: MathUtils.lerp(from.aspectRatio ?? 1, to.aspectRatio ?? 1, t),
  };
}

/** The offset from the center to the eye, in the camera's own axes. */
function eyeOffsetOf(pose: Pose) {
  return pose.position.clone().sub(pose.center).applyQuaternion(pose.orientation.clone().invert());
}

/** A transition in time with ease-in and ease-out. It begins with the first call of `poseAt`. */
export class CameraTransition {
  readonly to: Pose;
  readonly #from: Pose;
  readonly #durationMs: number;
  #startMs: number | undefined;

  constructor(from: Pose, to: Pose, durationMs: number) {
    this.to = to;
    this.#from = from;
    this.#durationMs = durationMs;
  }

  poseAt(nowMs: number): Pose {
    this.#startMs ??= nowMs;
    const t = this.#durationMs > 0 ? (nowMs - this.#startMs) / this.#durationMs : 1;
    return interpolatePose(this.#from, this.to, MathUtils.smoothstep(t, 0, 1));
  }
}
