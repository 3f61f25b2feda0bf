// What lights reach (navigation/lightScope.ts) in three.js, which shines on all that
// is in a scene with every light. Programs test it where a scene has scopes, and
// know nothing of it elsewhere.

import type { Group, WebGLProgramParametersWithUniforms } from "three";
import { ShaderChunk } from "three";
import type { LightScope } from "../../scene/lightScope.ts";
import type { SceneLightUniforms } from "./sceneLights.ts";
import { instancesDefine, scopedLightsDefine } from "../shaders/instanceRecord.ts";
import { replaceChunks } from "../shaders/replaceChunks.ts";

/** A group in which a shape is drawn. */
export interface ShapeGroup extends Group {
  /** The innermost that it is in; undefined where every light shines on it that is global. */
  lightScope?: LightScope;
}

export function hasLightScopes({ lightScopeRanges: lightScopeRanges }: SceneLightUniforms): boolean {
  return lightScopeRanges.value.length > 0;
}

/** By the numbers of lights that three.js fills in, in the order of `lightScopeRanges`. */
const fragmentChunk = /* glsl */ `
#define ${scopedLightsDefine}
#define ALL_LIGHTS ( NUM_POINT_LIGHTS + NUM_SPOT_LIGHTS + NUM_DIR_LIGHTS + 1 )
uniform vec2 lightScopeRanges[ALL_LIGHTS];
uniform vec3 scopedAmbients[ALL_LIGHTS];
#ifdef ${instancesDefine}
  flat varying float instanceLightScope;
  #define drawLightScope instanceLightScope
#else
  uniform float lightScope;
  #define drawLightScope lightScope
#endif

float lightShareInScope(int light) {
  vec2 reach = lightScopeRanges[light];
  return step(reach.x, drawLightScope) * step(drawLightScope, reach.y);
}

vec3 ambientLightInScope() {
  vec3 sum = vec3(0.0);
  for (int light = 0; light < ALL_LIGHTS; ++light) sum += lightShareInScope(light) * scopedAmbients[light];
  return sum;
}
`;

const lightsInScope = replaceChunks(ShaderChunk.lights_fragment_begin, [
  lit("getPointLightInfo( pointLight, geometryPosition, directLight );", "UNROLLED_LOOP_INDEX"),
  lit("getSpotLightInfo( spotLight, geometryPosition, directLight );", "NUM_POINT_LIGHTS + UNROLLED_LOOP_INDEX"),
  lit(
    "getDirectionalLightInfo( directionalLight, directLight );",
    "NUM_POINT_LIGHTS + NUM_SPOT_LIGHTS + UNROLLED_LOOP_INDEX",
  ),
  [
    "getAmbientLightIrradiance( ambientLightColor )",
    "getAmbientLightIrradiance( ambientLightColor + ambientLightInScope() )",
  ],
]);

function lit(statement: string, number: string): readonly [string, string] {
  return [statement, `${statement}\n\t\tdirectLight.color *= lightShareInScope( ${number} );`];
}

/** For `onBeforeCompile`. */
export function addLightScopes(
  shader: Pick<WebGLProgramParametersWithUniforms, "vertexShader" | "fragmentShader">,
): void {
  const fragmentShader = replaceChunks(shader.fragmentShader, [["#include <lights_fragment_begin>", lightsInScope]]);
  if (fragmentShader === shader.fragmentShader) return; // unlit
  shader.fragmentShader = fragmentChunk + fragmentShader;
  shader.vertexShader = `#define ${scopedLightsDefine}\n${shader.vertexShader}`;
}
