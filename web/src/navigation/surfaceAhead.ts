// Keeps the camera in front of surfaces while it approaches its center. The renderer picks one pixel to find the
// distance of the surface ahead, asynchronously and only while the camera approaches.

import type { Sphere } from "three";
import type { Pose } from "./cameraPose.ts";

/** The smallest distance to a surface that an approach reaches, as a share of the scene's radius. */
const minGapShare = 0.005;
/** The share of the remaining gap that one step may cross, so that the camera slows down before it stops. */
const maxStepShare = 0.5;

export class SurfaceAhead {
  /** The surface that was found from this pose, along its line to the center. */
  #known: { readonly pose: Pose; readonly distance: number } | undefined;
  /** Whether the next frame is to find the surface again. */
  #isSearchDue = false;
  /** The zoom factor that waits until the surface ahead is known; 1: none. */
  #waitingFactor = 1;

  /**
   * The pose between `from` and `to` up to which the camera may move without getting too close to the surface.
   * Movements away from the center, and outside of the scene's bounds, are not limited.
   */
  approach(from: Pose, to: Pose, { center, radius }: Sphere): Pose {
    const length = to.position.distanceTo(from.position);
    const distance = from.position.distanceTo(from.center);
    if (length === 0 || to.position.distanceTo(to.center) >= distance) {
      this.#waitingFactor = 1;
      return to;
    }
    this.#isSearchDue = true;
    const known = this.#known?.pose === from ? this.#known.distance : undefined;
    const gap = known === undefined ? undefined : Math.max(known - minGapShare * radius, 0);
    // Outside of the bounds nothing is in the way.
    const free = Math.max(from.position.distanceTo(center) - radius * 1.01, 0);
    const allowed = Math.min(length, Math.max(free, gap === undefined ? 0 : gap * maxStepShare));
    if (gap === undefined && allowed < length) this.#waitingFactor *= (distance - length) / (distance - allowed);
    if (allowed === 0) return from;
    const pose =
      allowed === length ? to : { ...to, position: from.position.clone().lerp(to.position, allowed / length) };
    this.#known = known === undefined ? undefined : { pose, distance: known - allowed };
    return pose;
  }

  /** `pose`, if the surface ahead of it is to be found; once after each approach. */
  takeSearch(pose: Pose): Pose | undefined {
    if (!this.#isSearchDue) return undefined;
    this.#isSearchDue = false;
    return pose;
  }

  /**
   * Sets the distance from `pose` to the surface ahead. Returns the zoom factor that has waited for it; 1: none has, or
   * the camera has left the line meanwhile.
   */
  found(pose: Pose, distance: number, current: Pose): number {
    const rest = this.#waitingFactor;
    this.#waitingFactor = 1;
    const isSameLine = pose.center === current.center && pose.orientation === current.orientation;
    if (!isSameLine) return 1;
    this.#known = { pose: current, distance: distance - pose.position.distanceTo(current.position) };
    return rest;
  }
}
