// The home pose, which the camera has until the user moves it: the bound viewpoint, or one that shows the whole scene.

import type { Sphere } from "three";
import type { SceneElement } from "../document/element.ts";
import type { BindingStack } from "./bindingStack.ts";
import type { Pose } from "./cameraPose.ts";
import type { ViewpointInstance } from "../scene/instances.ts";
import { poseFraming, poseOfViewpoint } from "./cameraPose.ts";
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
