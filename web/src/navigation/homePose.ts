// Where the camera stands as long as nobody moves it.

import type { Sphere } from "three";
import type { NavigationDescription } from "../document/description.ts";
import type { SceneElement } from "../document/element.ts";
import type { BindingStack } from "./bindingStack.ts";
import type { Pose } from "./cameraPose.ts";
import type { ViewpointInstance } from "../scene/instances.ts";
import { poseFraming, poseOfViewpoint } from "./cameraPose.ts";
import type { Avatar } from "./walkableGround.ts";
import type { NavigationType } from "./navigationType.ts";
import type { CameraSetting } from "./orbit.ts";
import { poseWith } from "./orbit.ts";

/** Those that are new to the stack, and say that they want to, are bound. */
export function bindViewpoints(stack: BindingStack<SceneElement>, viewpoints: readonly ViewpointInstance[]): void {
  const wanted = new Set(
    viewpoints.filter(({ viewpoint }) => viewpoint.set_bind || viewpoint.bind).map(({ element }) => element),
  );
  stack.setNodes(
    viewpoints.map(({ element }) => element),
    (element) => wanted.has(element),
  );
}

/** At the bound viewpoint, or so that all is seen; and what the author says of the camera. */
export function homePoseOf(viewpoint: Pose | undefined, camera: CameraSetting, sphere: Sphere): Pose {
  return poseWith(viewpoint ?? poseFraming(sphere), camera, sphere);
}

export function boundPoseOf(
  stack: BindingStack<SceneElement>,
  viewpoints: readonly ViewpointInstance[],
): Pose | undefined {
  const placed = viewpoints.find(({ element }) => element === stack.bound);
  return placed && poseOfViewpoint(placed);
}

/** Who goes through a scene: what `avatarSize` says, and X3D's usual person. */
export function avatarOf(navigation: NavigationDescription | undefined, sphere: Sphere): Avatar {
  const [radius = 0.25, height = 1.6, step = 0.75] = navigation?.avatarSize ?? [];
  // Nobody is so thin that his way is cut into more than a few paces.
  const least = Math.max(height / 100, sphere.radius * 1e-6);
  return { radius: Math.max(radius, least), height: Math.max(height, 0), step: Math.max(step, 0) };
}

/** Half of the distance that an avatar keeps from things (ISO/IEC 19775-1, 23.4.4); who examines keeps none. */
export function clearanceOf(type: NavigationType, { radius }: Avatar): number {
  return type === "walk" || type === "fly" ? radius / 2 : 0;
}
