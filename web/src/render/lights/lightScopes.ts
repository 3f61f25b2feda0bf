// Limits lights to their effect scopes (scene/effectScope.ts): three.js applies every light of a scene to every object.
// Programs of scenes without such lights contain no such code.

import type { WebGLProgramParametersWithUniforms } from "three";
import { ShaderChunk } from "three";
import { replaceChunks } from "../shaders/replaceChunks.ts";

/** Indices follow three.js' light loops, in the order of `lightScopeRanges`. */
const fragmentChunk = /* glsl */ `
#define ALL_LIGHTS ( NUM_POINT_LIGHTS + NUM_SPOT_LIGHTS + NUM_DIR_LIGHTS + 1 )
uniform vec2 lightScopeRanges[ALL_LIGHTS];
uniform vec3 scopedAmbients[ALL_LIGHTS];

// 1 if the light reaches the drawn object's scope, otherwise 0.
float lightShareInScope(int light) {
  return shareInScopes(lightScopeRanges[light]);
}

vec3 ambientLightInScope() {
  vec3 sum = vec3(0.0);
  for (int light = 0; light < ALL_LIGHTS; ++light) sum += lightShareInScope(light) * scopedAmbients[light];
  return sum;
}
`;

const lightsInScope = replaceChunks(ShaderChunk.lights_fragment_begin, [
  limitToScope("getPointLightInfo( pointLight, geometryPosition, directLight );", "UNROLLED_LOOP_INDEX"),
  limitToScope(
    "getSpotLightInfo( spotLight, geometryPosition, directLight );",
    "NUM_POINT_LIGHTS + UNROLLED_LOOP_INDEX",
  ),
  limitToScope(
    "getDirectionalLightInfo( directionalLight, directLight );",
    "NUM_POINT_LIGHTS + NUM_SPOT_LIGHTS + UNROLLED_LOOP_INDEX",
  ),
  [
    "getAmbientLightIrradiance( ambientLightColor )",
    "getAmbientLightIrradiance( ambientLightColor + ambientLightInScope() )",
  ],
]);

/** The replacement of a statement that computes `directLight` in one of three.js' light loops. */
function limitToScope(statement: string, lightIndex: string): readonly [string, string] {
  return [statement, `${statement}\n\t\tdirectLight.color *= lightShareInScope( ${lightIndex} );`];
}

/** Call in `onBeforeCompile`, before addDrawScope. Programs of unlit materials stay as they are. */
export function addLightScopes(
  shader: Pick<WebGLProgramParametersWithUniforms, "vertexShader" | "fragmentShader">,
): void {
  const fragmentShader = replaceChunks(shader.fragmentShader, [["#include <lights_fragment_begin>", lightsInScope]]);
  if (fragmentShader === shader.fragmentShader) return; // unlit
  shader.fragmentShader = fragmentChunk + fragmentShader;
}
