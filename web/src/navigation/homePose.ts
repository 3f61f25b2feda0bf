// The home pose, which the camera has until the user moves it, and the avatar that NavigationInfo describes.

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

/** Sets the stack's viewpoints and binds new ones whose `set_bind` or `bind` is true. */
export function bindViewpoints(stack: BindingStack<SceneElement>, viewpoints: readonly ViewpointInstance[]): void {
  stack.follow(
    viewpoints.map(({ element, viewpoint }) => ({ element, isBindRequested: viewpoint.set_bind || viewpoint.bind })),
  );
}

/** The bound viewpoint, or a pose that shows the whole scene, with the author's camera attributes applied. */
export function homePoseOf(viewpoint: Pose | undefined, camera: CameraSetting, sphere: Sphere): Pose {
  return poseWith(viewpoint ?? poseFraming(sphere), camera, sphere);
}

/** The pose of the bound viewpoint. */
export function boundPoseOf(
  stack: BindingStack<SceneElement>,
  viewpoints: readonly ViewpointInstance[],
): Pose | undefined {
  const bound = viewpoints.find(({ element }) => element === stack.bound);
  return bound && poseOfViewpoint(bound);
}

/** The avatar of `avatarSize`, with X3D's defaults. */
export function avatarOf(navigation: NavigationDescription | undefined, sphere: Sphere): Avatar {
  const [radius = 0.25, height = 1.6, step = 0.75] = navigation?.avatarSize ?? [];
  // A lower bound, because a walk is cut into steps of half the radius.
  const minRadius = Math.max(height / 100, sphere.radius * 1e-6);
  return { radius: Math.max(radius, minRadius), height: Math.max(height, 0), step: Math.max(step, 0) };
}

/**
 * Surfaces nearer than this distance need not be drawn: half the avatar's radius (ISO/IEC 19775-1, 23.4.4), 0 in
 * EXAMINE and NONE.
 */
export function clearanceOf(type: NavigationType, { radius }: Avatar): number {
  return type === "walk" || type === "fly" ? radius / 2 : 0;
}
