// GLSL of PhysicalMaterial: the metallic-roughness model of glTF 2.0, appendix B (Lambertian diffuse
// reflection, Schlick's Fresnel term, the GGX distribution, Walter et al. 2007), with height-correlated Smith
// visibility (Heitz 2014). Colours and light are linear; the result is encoded for the display.
//
// A light of intensity 1 makes a white, rough surface that faces it white, as with X3D's Material,
// so the factor 1/pi of all reflectances is left out. Metals reflect their surroundings only and
// would be black without any, so a uniform grey environment surrounds them, unless the scene has an EnvironmentLight
// (reflectance after Karis 2014, "Physically based shading on mobile").

import { surroundingsChunk } from "./surroundings.ts";
import type { Vec3 } from "../document/description.ts";

/** Defined in physical materials. */
export const physicalDefine = "PHYSICAL";

/** The GLSL functions directX3d and ambientX3d of this model. */
export const physicalLighting = /* glsl */ `
${surroundingsChunk}

// The reflectance at normal incidence, F0.
vec3 reflectanceF0(const in X3dMaterial material) {
  return mix(vec3(0.04), material.diffuseColor, material.metallic);
}

void directX3d(const in IncidentLight light, const in vec3 position, const in vec3 normal, const in vec3 viewDirection,
               const in vec3 clearcoatNormal, const in X3dMaterial material, inout ReflectedLight reflected) {
  float NL = dot(normal, light.direction);
  if (NL <= 0.0) return;
  vec3 halfway = normalize(light.direction + viewDirection);
  float NV = max(dot(normal, viewDirection), 1e-4);
  float NH = max(dot(normal, halfway), 0.0);
  float VH = max(dot(viewDirection, halfway), 0.0);
  float alpha = max(material.roughness * material.roughness, 1e-3);
  float alpha2 = alpha * alpha;
  float denominator = (NH * alpha2 - NH) * NH + 1.0;
  float distribution = alpha2 / (denominator * denominator);
  float visibility =
    0.5 / (NL * sqrt(NV * NV * (1.0 - alpha2) + alpha2) + NV * sqrt(NL * NL * (1.0 - alpha2) + alpha2));
  vec3 fresnel = mix(reflectanceF0(material), vec3(1.0), pow(1.0 - VH, 5.0));
  reflected.directDiffuse += light.color * NL * (1.0 - fresnel) * (1.0 - material.metallic) * material.diffuseColor;
  reflected.directSpecular += light.color * NL * fresnel * distribution * visibility;
}

vec3 environmentReflectance(const in X3dMaterial material, float NV) {
  const vec4 c0 = vec4(-1.0, -0.0275, -0.572, 0.022);
  const vec4 c1 = vec4(1.0, 0.0425, 1.04, -0.04);
  vec4 r = material.roughness * c0 + c1;
  float a004 = min(r.x * r.x, exp2(-9.28 * NV)) * r.x + r.y;
  vec2 ab = vec2(-1.04, 1.04) * a004 + r.zw;
  return reflectanceF0(material) * ab.x + ab.y;
}

void ambientX3d(const in vec3 light, const in vec3 position, const in vec3 normal, const in vec3 viewDirection,
                const in vec3 clearcoatNormal, const in X3dMaterial material, inout ReflectedLight reflected) {
  vec3 ambient = allAmbientLight(light);
  reflected.indirectDiffuse +=
    (ambient + surroundingIrradiance(normal)) * (1.0 - material.metallic) * material.diffuseColor;
  float NV = clamp(dot(normal, viewDirection), 0.0, 1.0);
  vec3 radiance =
    ambient + surroundingRadiance(reflect(-viewDirection, normal), material.roughness, material.metallic);
  reflected.indirectSpecular += radiance * environmentReflectance(material, NV);
}
`;

/**
 * Replaces three.js' chunk for output encoding. The renderer's encoding is off, so colours of physical materials are
 * encoded here.
 */
export const physicalOutput = /* glsl */ `
#include <colorspace_fragment>
#ifdef ${physicalDefine}
  gl_FragColor.rgb = clamp(gl_FragColor.rgb, 0.0, 1.0);
  ${toSrgbChunk("gl_FragColor.rgb")}
#endif
`;

/** The sRGB colour of a linear colour (IEC 61966-2-1). */
export function srgbOf(linear: Vec3): Vec3 {
  const [red, green, blue] = linear.map((channel) =>
    channel <= 0.0031308 ? 12.92 * channel : 1.055 * channel ** (1 / 2.4) - 0.055,
  );
  return [red ?? 0, green ?? 0, blue ?? 0];
}

/** GLSL that converts a colour variable from sRGB to linear (IEC 61966-2-1). */
export function toLinearChunk(color: string): string {
  return `${color} = mix(pow((${color} + 0.055) / 1.055, vec3(2.4)), ${color} / 12.92, vec3(lessThanEqual(${color}, vec3(0.04045))));`;
}

/** GLSL that converts a colour variable, whose channels are 0 … 1, from linear to sRGB (IEC 61966-2-1). */
export function toSrgbChunk(color: string): string {
  return `${color} = mix(pow(${color}, vec3(1.0 / 2.4)) * 1.055 - 0.055, ${color} * 12.92, vec3(lessThanEqual(${color}, vec3(0.0031308))));`;
}
