// What lights, clip planes, fogs and the EnvironmentLight of a scene add to the programs of its materials. Programs
// contain code only for what the scene has.

import type { IUniform } from "three";
import { makeLightUniforms } from "../lights/sceneLights.ts";
import type { ShaderTexts } from "../shaders/editShaders.ts";
import { makeClipPlaneUniforms } from "./clipPlanes.ts";
import type { SceneEffectUniforms } from "./effectUniforms.ts";
import { hasLightScopes, makeEnvironmentUniforms, makeFogUniforms } from "./effectUniforms.ts";
import { lateEnvironment } from "./lateEnvironment.ts";

/** Without any effect. */
export function makeSceneEffectUniforms(): SceneEffectUniforms {
  return {
    ...makeLightUniforms(),
    ...makeClipPlaneUniforms(),
    ...makeFogUniforms(),
    ...makeEnvironmentUniforms(),
  };
}

/** Equal for scenes whose materials need the same programs and the same edits of their shaders. */
export function sceneEffectsKey(shared: SceneEffectUniforms): string {
  const { clipPlanes, fogColors, environmentDiffuseSource } = shared;
  return [hasLightScopes(shared), clipPlanes.value.length, fogColors.value.length, environmentDiffuseSource.value].join(
    " ",
  );
}

export function sceneEffectUniformsOf(shared: SceneEffectUniforms): Record<string, IUniform> {
  const { attenuations } = shared;
  return { attenuations, ...(hasEffects(shared) && lateEnvironment.added?.effectUniformsOf(shared)) };
}

/** Edits shaders that include three.js' chunks for lights. */
export function addSceneEffects(shader: ShaderTexts, shared: SceneEffectUniforms): void {
  if (hasEffects(shared)) lateEnvironment.added?.addEffects(shader, shared);
}

/** Whether a scene has clip planes, fogs, an EnvironmentLight, or lights of a scope. */
function hasEffects(shared: SceneEffectUniforms): boolean {
  const { clipPlanes, fogColors, environmentDiffuseSource } = shared;
  const count = clipPlanes.value.length + fogColors.value.length;
  return count > 0 || hasLightScopes(shared) || environmentDiffuseSource.value !== "none";
}
