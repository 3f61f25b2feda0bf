// What lights, clip planes, fogs and the EnvironmentLight of a scene add to the programs of its materials. Programs
// contain code only for what the scene has.

import type { WebGLProgramParametersWithUniforms } from "three";
import { addLightScopes, hasLightScopes } from "../lights/lightScopes.ts";
import type { SceneLightUniforms } from "../lights/sceneLights.ts";
import { addDrawScope } from "../shaders/drawScope.ts";
import { replaceChunks } from "../shaders/replaceChunks.ts";
import type { ClipPlaneUniforms } from "./clipPlanes.ts";
import { addClipPlanes } from "./clipPlanes.ts";
import type { EnvironmentUniforms } from "./environmentLight.ts";
import { addEnvironmentLight, environmentUniformsOf } from "./environmentLight.ts";
import type { FogUniforms } from "./fogs.ts";
import { addFogs } from "./fogs.ts";

export type SceneEffectUniforms = SceneLightUniforms & ClipPlaneUniforms & FogUniforms & EnvironmentUniforms;

/** Equal for scenes whose materials need the same programs. */
export function sceneEffectsKey(shared: SceneEffectUniforms): string {
  const { clipPlanes, fogColors, environmentDiffuseSource } = shared;
  return [hasLightScopes(shared), clipPlanes.value.length, fogColors.value.length, environmentDiffuseSource.value].join(
    " ",
  );
}

/** Call in `onBeforeCompile`, after three.js' chunks for lights are in place. */
export function addSceneEffects(
  shader: Pick<WebGLProgramParametersWithUniforms, "vertexShader" | "fragmentShader" | "uniforms">,
  shared: SceneEffectUniforms,
): void {
  const { attenuations, lightScopeRanges, scopedAmbients, clipPlanes, clipPlaneScopes } = shared;
  const { fogColors, fogRanges, fogScopes } = shared;
  Object.assign(shader.uniforms, { attenuations, lightScopeRanges, scopedAmbients, clipPlanes, clipPlaneScopes });
  Object.assign(shader.uniforms, { fogColors, fogRanges, fogScopes });
  const {
    environmentDiffuseSource: { value: diffuseSource },
    ...environment
  } = environmentUniformsOf(shared);
  Object.assign(shader.uniforms, environment);
  const [planeCount, fogCount] = [clipPlanes.value.length, fogColors.value.length];
  if (hasLightScopes(shared)) addLightScopes(shader);
  if (planeCount > 0) addClipPlanes(shader, planeCount);
  if (fogCount > 0) addFogs(shader, fogCount);
  if (planeCount + fogCount > 0) addViewPoint(shader);
  if (diffuseSource !== "none") addEnvironmentLight(shader, diffuseSource);
  if (planeCount + fogCount > 0 || hasLightScopes(shared) || diffuseSource !== "none") addDrawScope(shader);
}

/** Gives the fragment shader its point in view coordinates. */
function addViewPoint(shader: Pick<WebGLProgramParametersWithUniforms, "vertexShader" | "fragmentShader">): void {
  const declaration = "varying vec3 viewPoint;\n";
  shader.vertexShader =
    declaration +
    replaceChunks(shader.vertexShader, [
      ["#include <fog_vertex>", "#include <fog_vertex>\n  viewPoint = mvPosition.xyz;"],
    ]);
  shader.fragmentShader = declaration + shader.fragmentShader;
}
