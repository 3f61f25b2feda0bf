// Walking and flying: the eye turns in place and moves. The center of rotation stays in front of the eye, so that a
// user can switch to EXAMINE.

import { Vector3 } from "three";
import type { Pose } from "./cameraPose.ts";
import { forwardOf, boundedRotation } from "./cameraPose.ts";

/** The movement that pressed keys request; each component is -1 … 1. */
export interface MovementInput {
  readonly forward: number;
  readonly right: number;
  readonly up: number;
  /** `turn` to the right and `look` upwards. */
  readonly turn: number;
  readonly look: number;
}

export const noMovement: MovementInput = { forward: 0, right: 0, up: 0, turn: 0, look: 0 };

/** Radians per second. */
const turnRate = 1;
const lookRate = 0.7;

export function isNoMovement(input: MovementInput): boolean {
  return Object.values(input).every((component: number) => component === 0);
}

/** Turns the eye by angles in radians, to the right and upwards, but not beyond the zenith or the nadir. */
export function turnPose(pose: Pose, right: number, upwards: number): Pose {
  const orientation = boundedRotation(pose, right, -upwards).multiply(pose.orientation).normalize();
  const distance = pose.position.distanceTo(pose.center);
  return { ...pose, orientation, center: pose.position.clone().addScaledVector(forwardOf({ orientation }), distance) };
}

/** Moves eye and center by lengths in scene units. Walking keeps the level, wherever the camera looks. */
export function movePose(pose: Pose, forward: number, right: number, up: number, isWalking: boolean): Pose {
  const ahead = forwardOf(pose);
  if (isWalking) {
    ahead.projectOnPlane(pose.up);
    // For a camera that looks straight down, ahead is towards the top of the view.
    if (ahead.lengthSq() < 1e-6)
      ahead.copy(new Vector3(0, 1, 0).applyQuaternion(pose.orientation)).projectOnPlane(pose.up);
    ahead.normalize();
  }
  const sideways = new Vector3(1, 0, 0).applyQuaternion(pose.orientation);
  const step = ahead.multiplyScalar(forward).addScaledVector(sideways, right).addScaledVector(pose.up, up);
  return { ...pose, position: pose.position.clone().add(step), center: pose.center.clone().add(step) };
}

/** The pose after some seconds of this movement at `speed`, in scene units per second. */
export function applyMovement(
  pose: Pose,
  input: MovementInput,
  seconds: number,
  speed: number,
  isWalking: boolean,
): Pose {
  const distance = speed * seconds;
  const turned = turnPose(pose, input.turn * turnRate * seconds, input.look * lookRate * seconds);
  return movePose(turned, input.forward * distance, input.right * distance, input.up * distance, isWalking);
}
