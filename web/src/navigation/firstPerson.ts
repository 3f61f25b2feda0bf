// Walking and flying: the eye turns in place and moves ahead; the centre of
// rotation stays in front of it, so that one can go on by examining.

import { Vector3 } from "three";
import type { Pose } from "./cameraPose.ts";
import { forwardOf, boundedRotation } from "./cameraPose.ts";

/** How one moves while keys are held, each -1 … 1. */
export interface MovementInput {
  readonly forward: number;
  readonly right: number;
  readonly up: number;
  /** To the right, and upwards. */
  readonly turn: number;
  readonly look: number;
}

export const noMovement: MovementInput = { forward: 0, right: 0, up: 0, turn: 0, look: 0 };

/** Radians a second. */
const turnRate = 1;
const lookRate = 0.7;

export function isNoMovement(motion: MovementInput): boolean {
  return Object.values(motion).every((part: number) => part === 0);
}

/** Turns the eye by angles in radians, to the right and upwards; never past the zenith. */
export function lookedAround(pose: Pose, right: number, upwards: number): Pose {
  const orientation = boundedRotation(pose, right, -upwards).multiply(pose.orientation).normalize();
  const distance = pose.position.distanceTo(pose.center);
  return { ...pose, orientation, center: pose.position.clone().addScaledVector(forwardOf({ orientation }), distance) };
}

/** Moves eye and centre by lengths in the scene. Who walks stays on one level, wherever he looks. */
export function moved(pose: Pose, forward: number, right: number, up: number, isWalking: boolean): Pose {
  const ahead = forwardOf(pose);
  if (isWalking) {
    ahead.projectOnPlane(pose.up);
    // Looking straight down, ahead is where the top of the picture is.
    if (ahead.lengthSq() < 1e-6)
      ahead.copy(new Vector3(0, 1, 0).applyQuaternion(pose.orientation)).projectOnPlane(pose.up);
    ahead.normalize();
  }
  const sideways = new Vector3(1, 0, 0).applyQuaternion(pose.orientation);
  const step = ahead.multiplyScalar(forward).addScaledVector(sideways, right).addScaledVector(pose.up, up);
  return { ...pose, position: pose.position.clone().add(step), center: pose.center.clone().add(step) };
}

/** Where one is after moving so for some seconds at `speed`, lengths a second. */
export function movedFor(pose: Pose, motion: MovementInput, seconds: number, speed: number, isWalking: boolean): Pose {
  const way = speed * seconds;
  const facing = lookedAround(pose, motion.turn * turnRate * seconds, motion.look * lookRate * seconds);
  return moved(facing, motion.forward * way, motion.right * way, motion.up * way, isWalking);
}
