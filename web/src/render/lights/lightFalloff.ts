// The falloff of light (lighting/falloff.ts) in three.js, which gives a light of a
// place one number for it, `decay`. Here that is the place of the light's
// `attenuation` in a list of the scene's.

import { ShaderChunk } from "three";
import { falloffChunk } from "../../lighting/falloff.ts";
import { replaceChunks } from "../shaders/replaceChunks.ts";

const chunk = /* glsl */ `
#define SCENE_LIGHTS ( NUM_POINT_LIGHTS + NUM_SPOT_LIGHTS + 1 )
uniform vec3 attenuations[SCENE_LIGHTS];
${falloffChunk}
float getDistanceAttenuation(const in float lightDistance, const in float radius, const in float number) {
  return attenuationAtDistance(lightDistance, radius, attenuations[int(number)]);
}

float getSpotAttenuation(const in float edgeCosine, const in float beamCosine, const in float cosine) {
  return attenuationInCone(edgeCosine, beamCosine, cosine);
}
`;

/** In the place of three's own chunk. */
export const lightsChunk =
  chunk +
  replaceChunks(ShaderChunk.lights_pars_begin, [
    ["float getDistanceAttenuation(", "float threeDistanceAttenuation("],
    ["float getSpotAttenuation(", "float threeSpotAttenuation("],
  ]);
