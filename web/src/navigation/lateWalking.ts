// Walking with a controller that is in a module of its own (document/parts.ts).

import type { Vector3 } from "three";
import { LateModule } from "../document/lateModule.ts";
import type { Pose } from "./cameraPose.ts";
import type { MovementInput } from "./firstPerson.ts";
import { applyMovement } from "./firstPerson.ts";
import type { DepthCamera, GroundSamples } from "./groundSamples.ts";
import type { Avatar } from "./walkableGround.ts";
import type { WalkController } from "./walkController.ts";

export const lateWalkController = new LateModule<() => WalkController>("walking");

/** Before the module has been loaded, steps wait and nothing moves. Speeds are in scene units per second. */
export class LateWalk {
  #loaded: WalkController | undefined;
  readonly #waitingSteps: Vector3[] = [];

  /** Whether the next frame differs from the last without pressed keys. */
  get isMoving(): boolean {
    return this.#controller?.isMoving === true;
  }

  /** Whether the avatar is known to be on a floor. */
  get isOnFloor(): boolean {
    return this.#controller?.isOnFloor === true;
  }

  push(step: Vector3, speed: number): void {
    if (this.#controller === undefined) this.#waitingSteps.push(step);
    else this.#controller.push(step, speed);
  }

  /** Goes the steps that have waited, once the module has been loaded. */
  pushWaiting(speed: number): void {
    if (this.#controller !== undefined)
      for (const step of this.#waitingSteps.splice(0)) this.#controller.push(step, speed);
  }

  stop(): void {
    this.#waitingSteps.length = 0;
    this.#controller?.stop();
  }

  /** The pose after some seconds of the movement that keys request, and of steps. */
  walk(pose: Pose, input: MovementInput, seconds: number, speed: number): Pose {
    if (this.#controller === undefined) return pose;
    const target = applyMovement(pose, input, seconds, speed, true);
    const move = target.position.clone().sub(pose.position);
    if (move.lengthSq() > 0) this.#controller.push(move, speed);
    const isLooking = input.turn !== 0 || input.look !== 0;
    const turned = isLooking ? { ...target, position: pose.position, center: target.center.clone().sub(move) } : pose;
    return this.#controller.walk(turned, seconds);
  }

  /** The depth camera that the ground is to be sampled with; undefined where no samples are needed. */
  depthCameraFor(pose: Pose, avatar: Avatar, speed: number): DepthCamera | undefined {
    return this.#controller?.depthCameraFor(pose, avatar, speed);
  }

  addGroundSamples(camera: DepthCamera, samples: GroundSamples): void {
    this.#controller?.addGroundSamples(camera, samples);
  }

  get #controller(): WalkController | undefined {
    return (this.#loaded ??= lateWalkController.added?.());
  }
}
