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

/** The key of a scene without clip planes, fogs, an EnvironmentLight and lights of a scope. */
const keyOfNoEffects = "false 0 0 none";

/** Call in `onBeforeCompile`, after three.js' chunks for lights are in place. */
export function addSceneEffects(shader: EffectShader, shared: SceneEffectUniforms): void {
  shader.uniforms.attenuations = shared.attenuations;
  if (sceneEffectsKey(shared) !== keyOfNoEffects) lateEnvironment()?.addEffects(shader, shared);
}
