// ClipPlane (ISO/IEC 19775-1, 11.4.1): the planes of a scene. clipPlaneShader.ts clips with them.

import type { Camera, Matrix4, Vector2 } from "three";
import { Vector4 } from "three";
import type { ClipPlaneInstance } from "../../scene/instances.ts";
import type { EffectScope } from "../../scene/effectScope.ts";
import { scopeRangeOf } from "../shaders/scopeRange.ts";

/** Further planes clip nothing. */
export const maxClipPlanes = 32;

export interface ClipPlaneUniforms {
  /** In view coordinates: a point is drawn where its distance is not negative. */
  readonly clipPlanes: { value: Vector4[] };
  /** For each plane, the first and the last scope that it clips. */
  readonly clipPlaneScopes: { value: Vector2[] };
}

export function makeClipPlaneUniforms(): ClipPlaneUniforms {
  return { clipPlanes: { value: [] }, clipPlaneScopes: { value: [] } };
}

/** Sets the scopes of a scene's planes; `setViewOfClipPlanes` sets their coordinates before each frame. */
export function setClipPlanes(
  { clipPlanes, clipPlaneScopes }: ClipPlaneUniforms,
  instances: readonly ClipPlaneInstance[],
): void {
  const drawn = instances.slice(0, maxClipPlanes);
  clipPlanes.value = drawn.map(() => new Vector4());
  clipPlaneScopes.value = drawn.map(({ scope }) => scopeRangeOf(scope));
}

/** Call before each frame, with the camera's matrices up to date. */
export function setViewOfClipPlanes(
  { clipPlanes }: ClipPlaneUniforms,
  instances: readonly ClipPlaneInstance[],
  { matrixWorld }: Camera,
): void {
  clipPlanes.value.forEach((uniform, i) => {
    const instance = instances[i];
    if (instance) uniform.copy(planeIn(instance.plane, matrixWorld));
  });
}

/** A plane of the scene in other coordinates, which `sceneFromOther` maps to the scene's. */
export function planeIn(plane: Vector4, sceneFromOther: Matrix4): Vector4 {
  return plane.clone().applyMatrix4(sceneFromOther.clone().transpose());
}

/** The planes that clip the draws of a scope, in scene coordinates. */
export function clipPlanesOf(scope: EffectScope, instances: readonly ClipPlaneInstance[]): readonly Vector4[] {
  return instances.slice(0, maxClipPlanes).flatMap((each) => (each.scope.contains(scope) ? [each.plane] : []));
}
