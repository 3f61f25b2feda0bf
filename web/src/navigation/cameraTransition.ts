// From one pose to another. What is interpolated is what people watch: the
// centre, the way to the eye as the camera sees it, and the orientation. A
// camera that goes around to the other side of a statue so keeps its distance
// instead of flying through.

import { MathUtils } from "three";
import type { Pose } from "./cameraPose.ts";

/** `share` 0 is exactly `from`, 1 exactly `to`. */
export function interpolatePose(from: Pose, to: Pose, share: number): Pose {
  if (share <= 0) return from;
  if (share >= 1) return to;
  const orientation = from.orientation.clone().slerp(to.orientation, share);
  const center = from.center.clone().lerp(to.center, share);
  const [a, b] = [towardsEye(from), towardsEye(to)];
  const distance = a.length() * (b.length() / (a.length() || 1)) ** share; // zooming feels even in ratios
  const direction = a.clone().lerp(b, share);
  const isDirected = direction.length() > 1e-3 * Math.max(a.length(), b.length()) && a.length() > 0 && b.length() > 0;
  const eye = isDirected ? direction.setLength(distance) : direction;
  return {
    position: center.clone().add(eye.applyQuaternion(orientation)),
    orientation,
    center,
    up: from.up.clone().lerp(to.up, share).normalize(),
    fieldOfView: MathUtils.lerp(from.fieldOfView, to.fieldOfView, share),
    aspectRatio: MathUtils.lerp(from.aspectRatio ?? 1, to.aspectRatio ?? 1, share),
  };
}

/** From the centre to the eye, in the camera's own axes. */
function towardsEye(pose: Pose) {
  return pose.position.clone().sub(pose.center).applyQuaternion(pose.orientation.clone().invert());
}

/** A journey in time: begins with the first call, slow at both ends. */
export class CameraTransition {
  readonly to: Pose;
  readonly #from: Pose;
  readonly #durationMs: number;
  #beganMs: number | undefined;

  constructor(from: Pose, to: Pose, durationMs: number) {
    this.to = to;
    this.#from = from;
    this.#durationMs = durationMs;
  }

  poseAt(nowMs: number): Pose {
    this.#beganMs ??= nowMs;
    const share = this.#durationMs > 0 ? (nowMs - this.#beganMs) / this.#durationMs : 1;
    return interpolatePose(this.#from, this.to, MathUtils.smoothstep(share, 0, 1));
  }
}
