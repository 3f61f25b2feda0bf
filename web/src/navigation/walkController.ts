// Walks: goes where it is asked to as far as there is floor and nothing in the
// way, climbs what is no higher than a step, falls where the floor ends. It knows
// only what the last look around has shown, and never goes beyond; while nobody
// moves it asks for no other.

import { Quaternion, Vector3 } from "three";
import type { Pose } from "./cameraPose.ts";
import type { Avatar, GroundPoint } from "./walkableGround.ts";
import { WalkableGround } from "./walkableGround.ts";
import type { DepthCamera, GroundSamples } from "./groundSamples.ts";
import { sceneFromCamera, cameraFromScene } from "./groundSamples.ts";

/** Of a body's height: what it falls faster in each second, as people of 1.6 m do in metres. */
const gravity = 9.8 / 1.6;
/** Steps that are climbed in a second. */
const climbRate = 4;
/** What is asked for while nothing is known is done later, but not more of it than so many seconds' way. */
const mostPatience = 0.25;
/** How far one looks: seconds of way, and of falling aside. */
const foresight = 0.4;

export class WalkController {
  /** Asked for and not gone yet. */
  #way = new Vector3();
  #speedOfFall = 0;
  #isSettled = true;
  #lookout: DepthCamera | undefined;
  #known: { readonly lookout: DepthCamera; readonly footing: WalkableGround } | undefined;
  #avatar: Avatar = { radius: 0, height: 0, step: 0 };

  /** Another frame will differ from the last. */
  get isMoving(): boolean {
    return !this.#isSettled || this.#way.lengthSq() > 0;
  }

  /** On a floor, as far as it knows. */
  get isOnFloor(): boolean {
    return this.#known?.footing.isHovering === false;
  }

  /** Another way to go, on top of what is asked for already; `speed` is the usual one, in lengths a second. */
  push(way: Vector3, speed: number): void {
    this.#way.add(way).clampLength(0, Math.max(speed * mostPatience, way.length()));
    this.#isSettled = false;
  }

  /** Forgets everything: somebody else has moved the camera. */
  stop(): void {
    this.#way.set(0, 0, 0);
    this.#speedOfFall = 0;
    this.#isSettled = true;
    this.#known = undefined;
    this.#lookout = undefined;
  }

  /** What must be looked at before it can go on; the same object until it has been. Undefined while nothing moves. */
  depthCameraFor(pose: Pose, avatar: Avatar, speed: number): DepthCamera | undefined {
    if (!this.isMoving) return undefined;
    this.#lookout ??= {
      eye: pose.position.clone(),
      orientation: new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), pose.up),
      reach: 3 * avatar.radius + speed * foresight,
    };
    this.#avatar = avatar;
    return this.#lookout;
  }

  /** What was seen from there; of use only while nobody else has moved the camera. */
  addGroundSamples(lookout: DepthCamera, surroundings: GroundSamples): void {
    if (lookout !== this.#lookout) return;
    this.#lookout = undefined;
    this.#known = { lookout, footing: new WalkableGround(surroundings, lookout.reach, this.#avatar) };
  }

  /** Where the eye is some seconds later. */
  walk(pose: Pose, seconds: number): Pose {
    if (this.#known === undefined || !this.isMoving) return pose;
    const { lookout, footing } = this.#known;
    const eye = cameraFromScene(lookout, pose.position);
    const rise = footing.isHovering ? this.#way.dot(pose.up) : 0;
    const place = this.#go(eye, lookout, footing);
    const height = this.#heightAt(place, eye.y + rise, footing, seconds);
    const position = sceneFromCamera(lookout, new Vector3(place.x, height, place.z));
    const moved = position.clone().sub(pose.position);
    if (moved.lengthSq() === 0) return pose;
    return { ...pose, position, center: pose.center.clone().add(moved) };
  }

  /** As much of the way as can be gone on what is known. */
  #go(eye: Vector3, lookout: DepthCamera, footing: WalkableGround): GroundPoint {
    const way = this.#way.clone().applyQuaternion(lookout.orientation.clone().invert());
    const length = Math.hypot(way.x, way.z);
    // Small enough for nothing to be stepped over.
    const paces = Math.ceil(length / (this.#avatar.radius / 2));
    const pace = { x: way.x / paces, z: way.z / paces };
    let place: GroundPoint = { x: eye.x, z: eye.z };
    for (let left = paces; left > 0; --left) {
      const next = nextPlace(place, pace, footing, this.#avatar.radius);
      if (next === "unknown") {
        this.#way.multiplyScalar(left / paces);
        return place;
      }
      place = next;
    }
    this.#way.set(0, 0, 0);
    return place;
  }

  /** Climbs evenly, falls ever faster. */
  #heightAt(place: GroundPoint, from: number, footing: WalkableGround, seconds: number): number {
    if (!footing.isKnown(place)) return from;
    const { height, step } = this.#avatar;
    const wanted = (footing.floorAt(place) ?? from - height) + height;
    this.#isSettled = Math.abs(wanted - from) < height * 1e-4;
    if (this.#isSettled || wanted >= from) {
      this.#speedOfFall = 0;
      return this.#isSettled ? from : Math.min(wanted, from + climbRate * Math.max(step, height / 10) * seconds);
    }
    this.#speedOfFall += gravity * height * seconds;
    return Math.max(wanted, from - this.#speedOfFall * seconds);
  }
}

/** One pace on, aside of what is in the way, or the same place where there is none. */
function nextPlace(
  from: GroundPoint,
  pace: GroundPoint,
  footing: WalkableGround,
  radius: number,
): GroundPoint | "unknown" {
  const clearance = Math.min(footing.clearanceAt(from), radius * 0.99);
  for (const way of [pace, { x: pace.x, z: 0 }, { x: 0, z: pace.z }]) {
    const wanted = { x: from.x + way.x, z: from.z + way.z };
    if (!footing.isKnown(wanted)) return "unknown";
    const place = footing.clearOf(footing.clearOf(wanted));
    const isFloor = footing.isHovering || footing.floorAt(place) !== undefined;
    const advance = (place.x - from.x) * pace.x + (place.z - from.z) * pace.z;
    if (isFloor && advance > 0 && footing.isKnown(place) && footing.clearanceAt(place) >= clearance) return place;
  }
  return from;
}
