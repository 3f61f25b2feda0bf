// Falloff of light (lighting/falloff.ts) in three.js. three.js passes one number per point or spot
// light to the shader, `decay`. Here it is an index into the uniform array `attenuations`.

import { ShaderChunk } from "three";
import { falloffChunk } from "../../lighting/falloff.ts";
import { replaceChunks } from "../shaders/replaceChunks.ts";

const chunk = /* glsl */ `
#define SCENE_LIGHTS ( NUM_POINT_LIGHTS + NUM_SPOT_LIGHTS + 1 )
uniform vec3 attenuations[SCENE_LIGHTS];
${falloffChunk}
float getDistanceAttenuation(const in float lightDistance, const in float radius, const in float decay) {
  return attenuationAtDistance(lightDistance, radius, attenuations[int(decay)]);
}

float getSpotAttenuation(const in float edgeCosine, const in float beamCosine, const in float cosine) {
  return attenuationInCone(edgeCosine, beamCosine, cosine);
}
`;

/** Replaces three.js' chunk `lights_pars_begin`, whose own falloff functions are renamed and unused. */
export const lightsChunk =
  chunk +
  replaceChunks(ShaderChunk.lights_pars_begin, [
    ["float getDistanceAttenuation(", "float threeDistanceAttenuation("],
    ["float getSpotAttenuation(", "float threeSpotAttenuation("],
  ]);
