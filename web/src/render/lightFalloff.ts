// How light becomes less with distance and towards the edge of a cone, as X3D says
// it (ISO/IEC 19775-1, 17.2.2.4): at distance d by 1 / max(a + b d + c d^2, 1), to
// nothing beyond the radius; between beamWidth and cutOffAngle evenly by angle.
//
// three.js gives a light of a place one number for its falloff, `decay`. Here it is
// the place of the light's `attenuation` in a list of the scene's.

import { ShaderChunk, Vector3 } from "three";
import { replaceEach } from "./vertexChunk.ts";

export interface FalloffUniforms {
  /** In the order of the lights' numbers; never empty. */
  readonly attenuations: { value: Vector3[] };
}

export const noAttenuations = (): Vector3[] => [new Vector3(1, 0, 0)];

const falloff = /* glsl */ `
#define SCENE_LIGHTS ( NUM_POINT_LIGHTS + NUM_SPOT_LIGHTS + 1 )
uniform vec3 attenuations[SCENE_LIGHTS];

float getDistanceAttenuation(const in float lightDistance, const in float radius, const in float number) {
  vec3 powers = vec3(1.0, lightDistance, lightDistance * lightDistance);
  return lightDistance > radius ? 0.0 : 1.0 / max(dot(attenuations[int(number)], powers), 1.0);
}

float getSpotAttenuation(const in float edgeCosine, const in float beamCosine, const in float cosine) {
  if (cosine <= edgeCosine) return 0.0;
  float edge = acos(edgeCosine);
  float beam = acos(beamCosine);
  return beam < edge ? clamp((edge - acos(min(cosine, 1.0))) / (edge - beam), 0.0, 1.0) : 1.0;
}
`;

/** In the place of three's own chunk. */
export const lightsChunk = falloff + replaceEach(ShaderChunk.lights_pars_begin, [
  ["float getDistanceAttenuation(", "float usualDistanceAttenuation("],
  ["float getSpotAttenuation(", "float usualSpotAttenuation("],
]);
