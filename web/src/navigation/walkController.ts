// The camera controller of the WALK type: moves an avatar over walkable ground, past obstacles, up steps, and down
// where the floor ends. It moves only within the area that the latest ground samples cover, and requests new samples
// only while the avatar moves.

import { Quaternion, Vector3 } from "three";
import type { Pose } from "./cameraPose.ts";
import type { Avatar, GroundPoint } from "./walkableGround.ts";
import { WalkableGround } from "./walkableGround.ts";
import type { DepthCamera, GroundSamples } from "./groundSamples.ts";
import { sceneFromCamera, cameraFromScene } from "./groundSamples.ts";

/** In avatar heights per second squared: 9.8 m/s² for an avatar of 1.6 m. */
const gravity = 9.8 / 1.6;
/** Step heights climbed per second. */
const climbRate = 4;
/** Movement requested while samples are missing is carried out later, up to this many seconds of it. */
const maxBacklogSeconds = 0.25;
/** The ground samples cover the movement of this many seconds. */
const lookAheadSeconds = 0.4;

export class WalkController {
  /** The requested movement that is still to be carried out. */
  #pendingMove = new Vector3();
  /** How long it may be from the next frame on, in scene units. */
  #maxPendingLength = 0;
  #fallSpeed = 0;
  #isSettled = true;
  #requestedCamera: DepthCamera | undefined;
  #sampled: { readonly camera: DepthCamera; readonly ground: WalkableGround } | undefined;
  #avatar: Avatar = { radius: 0, height: 0, step: 0 };

  /** Whether the next frame differs from the last. */
  get isMoving(): boolean {
    return !this.#isSettled || this.#pendingMove.lengthSq() > 0;
  }

  /** Whether the latest samples show a floor below the avatar. */
  get isOnFloor(): boolean {
    return this.#sampled?.ground.isHovering === false;
  }

  /**
   * Requests more movement; `speed`, in scene units per second, bounds how much is kept in the next frame. Requests
   * between two frames add up: of two fingers, the second takes back the first one's pinch.
   */
  push(move: Vector3, speed: number): void {
    this.#pendingMove.add(move);
    this.#maxPendingLength = Math.max(this.#maxPendingLength, speed * maxBacklogSeconds, move.length());
    this.#isSettled = false;
  }

  /** Discards pending movement and samples: something else has moved the camera. */
  stop(): void {
    this.#pendingMove.set(0, 0, 0);
    this.#maxPendingLength = 0;
    this.#fallSpeed = 0;
    this.#isSettled = true;
    this.#sampled = undefined;
    this.#requestedCamera = undefined;
  }

  /**
   * The depth camera to sample the ground with before the avatar can move on; the same object until the samples
   * arrive. Undefined while nothing moves.
   */
  depthCameraFor(pose: Pose, avatar: Avatar, speed: number): DepthCamera | undefined {
    if (!this.isMoving) return undefined;
    this.#requestedCamera ??= {
      eye: pose.position.clone(),
      orientation: new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), pose.up),
      range: 3 * avatar.radius + speed * lookAheadSeconds,
    };
    this.#avatar = avatar;
    return this.#requestedCamera;
  }

  /** Takes the samples of a depth camera; ignored where the camera has been moved since. */
  addGroundSamples(camera: DepthCamera, samples: GroundSamples): void {
    if (camera !== this.#requestedCamera) return;
    this.#requestedCamera = undefined;
    this.#sampled = { camera, ground: new WalkableGround(samples, camera.range, this.#avatar) };
  }

  /** The pose after some seconds of walking. */
  walk(pose: Pose, seconds: number): Pose {
    if (this.#maxPendingLength > 0) this.#pendingMove.clampLength(0, this.#maxPendingLength);
    this.#maxPendingLength = 0;
    if (this.#sampled === undefined || !this.isMoving) return pose;
    const { camera, ground } = this.#sampled;
    const eye = cameraFromScene(camera, pose.position);
    const rise = ground.isHovering ? this.#pendingMove.dot(pose.up) : 0;
    const point = this.#moveAlongGround(eye, camera, ground);
    const height = this.#eyeHeightAt(point, eye.y + rise, ground, seconds);
    const position = sceneFromCamera(camera, new Vector3(point.x, height, point.z));
    const displacement = position.clone().sub(pose.position);
    if (displacement.lengthSq() === 0) return pose;
    return { ...pose, position, center: pose.center.clone().add(displacement) };
  }

  /** Carries out as much of the pending movement as the samples cover. */
  #moveAlongGround(eye: Vector3, camera: DepthCamera, ground: WalkableGround): GroundPoint {
    const move = this.#pendingMove.clone().applyQuaternion(camera.orientation.clone().invert());
    const length = Math.hypot(move.x, move.z);
    // Steps of half the radius do not jump over an obstacle.
    const stepCount = Math.ceil(length / (this.#avatar.radius / 2));
    const step = { x: move.x / stepCount, z: move.z / stepCount };
    let point: GroundPoint = { x: eye.x, z: eye.z };
    for (let remaining = stepCount; remaining > 0; --remaining) {
      const next = nextPoint(point, step, ground, this.#avatar.radius);
      if (next === "unknown") {
        this.#pendingMove.multiplyScalar(remaining / stepCount);
        return point;
      }
      point = next;
    }
    this.#pendingMove.set(0, 0, 0);
    return point;
  }

  /** The height of the eye: the avatar climbs at a constant rate and falls with acceleration. */
  #eyeHeightAt(point: GroundPoint, from: number, ground: WalkableGround, seconds: number): number {
    if (!ground.isCovered(point)) return from;
    const { height, step } = this.#avatar;
    const target = (ground.floorAt(point) ?? from - height) + height;
    this.#isSettled = Math.abs(target - from) < height * 1e-4;
    if (this.#isSettled || target >= from) {
      this.#fallSpeed = 0;
      return this.#isSettled ? from : Math.min(target, from + climbRate * Math.max(step, height / 10) * seconds);
    }
    this.#fallSpeed += gravity * height * seconds;
    return Math.max(target, from - this.#fallSpeed * seconds);
  }
}

/** The point after one step, clear of obstacles; the same point where all directions are blocked. */
function nextPoint(
  from: GroundPoint,
  step: GroundPoint,
  ground: WalkableGround,
  radius: number,
): GroundPoint | "unknown" {
  const clearance = Math.min(ground.clearanceAt(from), radius * 0.99);
  for (const move of [step, { x: step.x, z: 0 }, { x: 0, z: step.z }]) {
    const target = { x: from.x + move.x, z: from.z + move.z };
    if (!ground.isCovered(target)) return "unknown";
    const point = ground.clearOf(ground.clearOf(target));
    const isFloor = ground.isHovering || ground.floorAt(point) !== undefined;
    const advance = (point.x - from.x) * step.x + (point.z - from.z) * step.z;
    if (isFloor && advance > 0 && ground.isCovered(point) && ground.clearanceAt(point) >= clearance) return point;
  }
  return from;
}
