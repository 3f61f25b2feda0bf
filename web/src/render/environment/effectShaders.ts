// The GLSL of a scene's clip planes, fogs, EnvironmentLight and scopes of lights.

import { addLightScopes } from "../lights/lightScopes.ts";
import { addDrawScope } from "../shaders/drawScope.ts";
import { replaceChunks } from "../shaders/replaceChunks.ts";
import { addClipPlanes } from "./clipPlaneShader.ts";
import { addEnvironmentLight, environmentUniformsOf } from "./environmentLight.ts";
import { addFogs } from "./fogs.ts";
import type { EffectShader, SceneEffectUniforms } from "./effectUniforms.ts";
import { hasLightScopes } from "./effectUniforms.ts";

/**
 * Call in `onBeforeCompile` where a scene has any of these effects, when the shader includes three.js' chunks for lights.
 */
export function addEffects(shader: EffectShader, shared: SceneEffectUniforms): void {
  const { lightScopeRanges, scopedAmbients, clipPlanes, clipPlaneScopes, fogColors, fogRanges, fogScopes } = shared;
  Object.assign(shader.uniforms, { lightScopeRanges, scopedAmbients, clipPlanes, clipPlaneScopes });
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
  addDrawScope(shader);
}

/** Gives the fragment shader its point in view coordinates. */
function addViewPoint(shader: EffectShader): void {
  const declaration = "varying vec3 viewPoint;\n";
  shader.vertexShader =
    declaration +
    replaceChunks(shader.vertexShader, [
      ["#include <fog_vertex>", "#include <fog_vertex>\n  viewPoint = mvPosition.xyz;"],
    ]);
  shader.fragmentShader = declaration + shader.fragmentShader;
}
