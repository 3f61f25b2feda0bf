// Falloff of light in X3D (ISO/IEC 19775-1, 17.2.2.4). At distance d, light is attenuated by
// 1 / max(a + b d + c d^2, 1); beyond the radius there is none. Between beamWidth and cutOffAngle,
// intensity falls linearly with the angle.

import type { Vec3 } from "../document/description.ts";

/** GLSL functions of a, b, c and of the cosines of the angles. */
export const falloffChunk = /* glsl */ `
float attenuationAtDistance(const in float lightDistance, const in float radius, const in vec3 attenuation) {
  vec3 powers = vec3(1.0, lightDistance, lightDistance * lightDistance);
  return lightDistance > radius ? 0.0 : 1.0 / max(dot(attenuation, powers), 1.0);
}

float attenuationInCone(const in float edgeCosine, const in float beamCosine, const in float cosine) {
  if (cosine <= edgeCosine) return 0.0;
  float edge = acos(edgeCosine);
  float beam = acos(beamCosine);
  return beam < edge ? clamp((edge - acos(min(cosine, 1.0))) / (edge - beam), 0.0, 1.0) : 1.0;
}
`;

export interface Falloff {
  readonly radius: number;
  readonly attenuation: Vec3;
}

/** Lengths are in the light's coordinate system (17.4.2): a scaled-up light reaches further. */
export function scaledFalloff({ radius, attenuation: [constant, linear, square] }: Falloff, scale: number): Falloff {
  return { radius: radius * scale, attenuation: [constant, linear / scale, square / scale ** 2] };
}

/** A SpotLight's cone, in radians: where its light ends, and where it is full. */
export function coneOf({ cutOffAngle, beamWidth }: { readonly cutOffAngle: number; readonly beamWidth: number }): {
  edge: number;
  beam: number;
} {
  const edge = Math.min(cutOffAngle, Math.PI / 2);
  return { edge, beam: edge * Math.min(beamWidth / cutOffAngle, 1) };
}
