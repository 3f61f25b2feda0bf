// The GLSL of a scene's clip planes, fogs, EnvironmentLight and scopes of lights.

import type { IUniform } from "three";
import { addLightScopes } from "../lights/lightScopes.ts";
import { addDrawScope } from "../shaders/drawScope.ts";
import type { ShaderTexts } from "../shaders/editShaders.ts";
import { replaceChunks } from "../shaders/replaceChunks.ts";
import { addClipPlanes } from "./clipPlaneShader.ts";
import { addEnvironmentLight, environmentUniformsOf } from "./environmentLight.ts";
import { addFogs } from "./fogs.ts";
import type { SceneEffectUniforms } from "./effectUniforms.ts";
import { hasLightScopes } from "./effectUniforms.ts";

/** The uniforms of the GLSL that `addEffects` adds. */
export function effectUniformsOf(shared: SceneEffectUniforms): Record<string, IUniform> {
  const { lightScopeRanges, scopedAmbients, clipPlanes, clipPlaneScopes, fogColors, fogRanges, fogScopes } = shared;
  const scopes = { lightScopeRanges, scopedAmbients, clipPlanes, clipPlaneScopes };
  return { ...scopes, fogColors, fogRanges, fogScopes, ...environmentUniformsOf(shared) };
}

/** Edits the shaders of a scene with any of these effects, when they include three.js' chunks for lights. */
export function addEffects(shader: ShaderTexts, shared: SceneEffectUniforms): void {
  const { clipPlanes, fogColors, environmentDiffuseSource } = shared;
  const [planeCount, fogCount] = [clipPlanes.value.length, fogColors.value.length];
  const diffuseSource = environmentDiffuseSource.value;
  if (hasLightScopes(shared)) addLightScopes(shader);
  if (planeCount > 0) addClipPlanes(shader, planeCount);
  if (fogCount > 0) addFogs(shader, fogCount);
  if (planeCount + fogCount > 0) addViewPoint(shader);
  if (diffuseSource !== "none") addEnvironmentLight(shader, diffuseSource);
  addDrawScope(shader);
}

/** Gives the fragment shader its point in view coordinates. */
function addViewPoint(shader: ShaderTexts): void {
  const declaration = "varying vec3 viewPoint;\n";
  shader.vertexShader =
    declaration +
    replaceChunks(shader.vertexShader, [
      ["#include <fog_vertex>", "#include <fog_vertex>\n  viewPoint = mvPosition.xyz;"],
    ]);
  shader.fragmentShader = declaration + shader.fragmentShader;
}
