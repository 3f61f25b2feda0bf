// The home pose over time: another viewpoint is bound or the bound one moves, the scene grows, or the author sets the
// camera.

import { Sphere, Vector3 } from "three";
import type { Pose } from "./cameraPose.ts";
import { poseFraming } from "./cameraPose.ts";
import { homePoseOf } from "./homePose.ts";
import type { CameraSetting } from "./orbit.ts";

/** `grown`: the pose has changed with the bounds of the scene only. */
type HomeChange = "none" | "grown" | "replaced";

export class CameraHome {
  #pose = poseFraming(new Sphere(new Vector3(), 1));
  /** What the pose follows from beside the bounds. */
  #key = "";

  /** The same object until it changes. */
  get pose(): Pose {
    return this.#pose;
  }

  /** `viewpoint`: the pose of the bound one; `bounds`: what a pose shows where there is none. */
  follow(viewpoint: Pose | undefined, camera: CameraSetting, bounds: Sphere): HomeChange {
    const pose = homePoseOf(viewpoint, camera, bounds);
    const key = JSON.stringify([viewpoint, camera]);
    const isReplaced = key !== this.#key;
    if (!isReplaced && JSON.stringify(pose) === JSON.stringify(this.#pose)) return "none";
    this.#pose = pose;
    this.#key = key;
    return isReplaced ? "replaced" : "grown";
  }
}

/** What the initial view shows of a scene. `motion`: the bounds of all moments of what moves in it. */
export function shownBoundsOf(scene: Sphere, motion: Sphere | undefined): Sphere {
  if (motion === undefined) return scene;
  // The sphere around a box that is within another box protrudes by less than this from the other's sphere.
  const isWithin = motion.center.distanceTo(scene.center) + scene.radius <= Math.SQRT2 * motion.radius;
  return isWithin ? motion : motion.clone().union(scene);
}
