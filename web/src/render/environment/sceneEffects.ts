// What lights, clip planes, fogs and the EnvironmentLight of a scene add to the programs of its materials. Programs
// contain code only for what the scene has.

import type { EffectShader, SceneEffectUniforms } from "./effectUniforms.ts";
import { hasLightScopes } from "./effectUniforms.ts";
import { lateEnvironment } from "./lateEnvironment.ts";

/** Equal for scenes whose materials need the same programs. */
export function sceneEffectsKey(shared: SceneEffectUniforms): string {
  const { clipPlanes, fogColors, environmentDiffuseSource } = shared;
  return [hasLightScopes(shared), clipPlanes.value.length, fogColors.value.length, environmentDiffuseSource.value].join(
    " ",
  );
}

/** Call in `onBeforeCompile`, when the shader includes three.js' chunks for lights. */
export function addSceneEffects(shader: EffectShader, shared: SceneEffectUniforms): void {
  shader.uniforms.attenuations = shared.attenuations;
  if (hasEffects(shared)) lateEnvironment()?.addEffects(shader, shared);
}

/** Whether a scene has clip planes, fogs, an EnvironmentLight, or lights of a scope. */
function hasEffects(shared: SceneEffectUniforms): boolean {
  const { clipPlanes, fogColors, environmentDiffuseSource } = shared;
  const count = clipPlanes.value.length + fogColors.value.length;
  return count > 0 || hasLightScopes(shared) || environmentDiffuseSource.value !== "none";
}
