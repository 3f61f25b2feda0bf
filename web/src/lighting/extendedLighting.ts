// GLSL of the extensions of PhysicalMaterial (glTF's KHR_materials_*): layers and terms that are added to the
// metallic-roughness model of physicalLighting.ts, whose functions this chunk replaces. As there, the factor 1/pi of
// all reflectances is left out, and a uniform grey environment surrounds metals and coats.
//
// Thin films: Airy's sum of reflections at three wavelengths. Sheen: Estevez and Kulla's distribution (2017) with
// Neubelt's visibility; `sheenAlbedo` is our fit of its integral over the hemisphere (rms error 0.015). Transmission
// reads what has been drawn behind the surface, refracted once.

import type { ExtensionTextureRole } from "../document/description.ts";
import { ambientLightChunk, surroundingsChunk } from "./surroundings.ts";
import { extensionUniforms } from "./extensionUniforms.ts";
import { toLinearChunk } from "./physicalLighting.ts";

const declarations = Object.entries(extensionUniforms)
  .map(([name, type]) => `uniform ${type} ${name};`)
  .join("\n");

/** Replaces the functions directX3d and ambientX3d. `surface` is filled by `extendedSurface`. */
export const extendedLighting = /* glsl */ `
${declarations}
uniform sampler2D backdrop;
uniform mat4 projectionMatrix;
varying float vShapeScale;
${ambientLightChunk}
${surroundingsChunk}

struct ExtendedSurface {
  vec3 f0, f90, sheen, tangent, bitangent, coatNormal;
  float sheenRoughness, coat, coatRoughness, film, filmThickness, alphaT, transmission, thickness;
} surface;

float square(float x) {
  return x * x;
}

// Directions of growing texture coordinates in the plane of the normal; any two directions without coordinates.
mat2x3 tangentsOf(vec3 normal, vec2 uv) {
  vec3 across = cross(-dFdy(vViewPosition), normal), down = cross(normal, -dFdx(vViewPosition));
  vec2 dx = dFdx(uv), dy = dFdy(uv);
  vec3 tangent = across * dx.x + down * dy.x, bitangent = across * dx.y + down * dy.y;
  float size = max(dot(tangent, tangent), dot(bitangent, bitangent));
  if (size <= 0.0) {
    tangent = normalize(cross(abs(normal.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0), normal));
    return mat2x3(tangent, cross(normal, tangent));
  }
  return mat2x3(tangent, bitangent) * inversesqrt(size);
}

float fresnelWeight(float cosine) {
  float x = clamp(1.0 - cosine, 0.0, 1.0);
  return x * x * x * x * x;
}

// The reflectance of a thin film on the surface, by Airy's formula; amplitudes by Schlick's approximation.
vec3 filmReflectance(float cosine) {
  const vec3 wavelengths = vec3(612.0, 549.0, 464.0);
  float n = mix(1.0, iridescenceIndexOfRefraction, smoothstep(0.0, 0.03, surface.filmThickness));
  float inner = sqrt(max(1.0 - (1.0 - cosine * cosine) / (n * n), 0.0));
  float r12 = mix(square((n - 1.0) / (n + 1.0)), 1.0, fresnelWeight(cosine));
  vec3 root = sqrt(clamp(surface.f0, 0.0, 0.9999));
  vec3 base = (1.0 + root) / (1.0 - root);
  vec3 amplitude = (base - n) / (base + n);
  vec3 r23 = mix(amplitude * amplitude, vec3(1.0), fresnelWeight(inner));
  // The phase is reversed at the first boundary, and at the second where the base is denser than the film.
  vec3 product = sqrt(r12 * r23) * -sign(amplitude);
  vec3 phase = 4.0 * PI * n * inner * surface.filmThickness / wavelengths;
  vec3 interference = -2.0 * product * cos(phase);
  return clamp((r12 + r23 + interference) / (1.0 + r12 * r23 + interference), 0.0, 1.0);
}

vec3 fresnelAt(float cosine) {
  vec3 fresnel = mix(surface.f0, surface.f90, fresnelWeight(cosine));
  return surface.film > 0.0 ? mix(fresnel, filmReflectance(cosine), surface.film) : fresnel;
}

float coatFresnel(float cosine) {
  return surface.coat * mix(0.04, 1.0, fresnelWeight(cosine));
}

float sheenAlbedo(float NV) {
  float r = surface.sheenRoughness, inverse = 1.0 / (r + 0.1);
  return clamp(exp((2.228 - 1.132 * r - 2.71 * inverse) * NV - 0.48 - 0.444 * r + 0.353 * inverse), 0.0, 1.0);
}

// What is left of light that passes the coat and the sheen.
float underLayers(float NV, vec3 viewDirection) {
  vec3 sheen = surface.sheen;
  float coatNV = clamp(dot(surface.coatNormal, viewDirection), 0.0, 1.0);
  return (1.0 - coatFresnel(coatNV)) * (1.0 - max(sheen.r, max(sheen.g, sheen.b)) * sheenAlbedo(NV));
}

// GGX with different widths along tangent and bitangent, times its visibility and 4 NL NV / pi.
float microfacets(float NL, float NV, vec3 normal, vec3 halfway, vec3 light, vec3 view, float alphaT, float alphaB) {
  float TH = dot(surface.tangent, halfway), BH = dot(surface.bitangent, halfway), NH = dot(normal, halfway);
  float distribution = 1.0 / (alphaT * alphaB * square(square(TH / alphaT) + square(BH / alphaB) + NH * NH));
  float maskView = NL * length(vec3(alphaT * dot(surface.tangent, view), alphaB * dot(surface.bitangent, view), NV));
  float maskLight = NV * length(vec3(alphaT * dot(surface.tangent, light), alphaB * dot(surface.bitangent, light), NL));
  return distribution * 0.5 / max(maskView + maskLight, 1e-5);
}

float coatLobe(vec3 light, vec3 view, vec3 halfway) {
  float NL = dot(surface.coatNormal, light);
  if (NL <= 0.0) return 0.0;
  float NV = max(dot(surface.coatNormal, view), 1e-4), NH = max(dot(surface.coatNormal, halfway), 0.0);
  float alpha2 = square(max(square(surface.coatRoughness), 1e-3));
  float denominator = NH * NH * (alpha2 - 1.0) + 1.0;
  float mask = NL * sqrt(NV * NV * (1.0 - alpha2) + alpha2) + NV * sqrt(NL * NL * (1.0 - alpha2) + alpha2);
  return NL * coatFresnel(max(dot(view, halfway), 0.0)) * alpha2 / square(denominator) * 0.5 / max(mask, 1e-5);
}

void directX3d(const in IncidentLight light, const in vec3 position, const in vec3 normal, const in vec3 viewDirection,
               const in vec3 clearcoatNormal, const in X3dMaterial material, inout ReflectedLight reflected) {
  vec3 halfway = normalize(light.direction + viewDirection);
  reflected.directSpecular += light.color * coatLobe(light.direction, viewDirection, halfway);
  float NL = dot(normal, light.direction);
  if (NL <= 0.0) return;
  float NV = max(dot(normal, viewDirection), 1e-4), NH = max(dot(normal, halfway), 0.0);
  vec3 fresnel = fresnelAt(max(dot(viewDirection, halfway), 0.0));
  float alpha = max(square(material.roughness), 1e-3);
  vec3 incident = light.color * NL * underLayers(NV, viewDirection);
  float strongest = max(fresnel.r, max(fresnel.g, fresnel.b));
  reflected.directDiffuse += incident * (1.0 - strongest) * (1.0 - material.metallic) * (1.0 - surface.transmission) *
    material.diffuseColor;
  reflected.directSpecular += incident * fresnel *
    microfacets(NL, NV, normal, halfway, light.direction, viewDirection, max(surface.alphaT, alpha), alpha);
  float inverse = 1.0 / max(square(surface.sheenRoughness), 1e-3);
  float charlie = (2.0 + inverse) * pow(max(1.0 - NH * NH, 1e-4), inverse * 0.5) * 0.5;
  reflected.directSpecular += light.color * NL * surface.sheen * charlie / (4.0 * (NL + NV - NL * NV));
}

void ambientX3d(const in vec3 light, const in vec3 position, const in vec3 normal, const in vec3 viewDirection,
                const in vec3 clearcoatNormal, const in X3dMaterial material, inout ReflectedLight reflected) {
  const vec4 c0 = vec4(-1.0, -0.0275, -0.572, 0.022);
  const vec4 c1 = vec4(1.0, 0.0425, 1.04, -0.04);
  float NV = clamp(dot(normal, viewDirection), 0.0, 1.0), under = underLayers(NV, viewDirection);
  vec4 r = material.roughness * c0 + c1;
  float a004 = min(r.x * r.x, exp2(-9.28 * NV)) * r.x + r.y;
  vec2 ab = vec2(-1.04, 1.04) * a004 + r.zw;
  vec3 f0 = surface.film > 0.0 ? mix(surface.f0, filmReflectance(NV), surface.film) : surface.f0;
  vec3 ambient = allAmbientLight(light), irradiance = ambient + surroundingIrradiance(normal);
  reflected.indirectDiffuse += under * irradiance * (1.0 - material.metallic) * (1.0 - surface.transmission) *
    material.diffuseColor;
  vec3 radiance =
    ambient + surroundingRadiance(reflect(-viewDirection, normal), material.roughness, material.metallic);
  reflected.indirectSpecular += under * radiance * (f0 * ab.x + surface.f90 * ab.y);
  float coatNV = clamp(dot(surface.coatNormal, viewDirection), 0.0, 1.0);
  vec3 coatDirection = reflect(-viewDirection, surface.coatNormal);
  reflected.indirectSpecular +=
    (ambient + surroundingRadiance(coatDirection, surface.coatRoughness, 1.0)) * coatFresnel(coatNV);
  reflected.indirectSpecular += irradiance * surface.sheen * sheenAlbedo(NV);
}

vec3 backdropAt(vec3 viewPosition, vec3 ray, float lod) {
  vec4 clip = projectionMatrix * vec4(viewPosition + ray, 1.0);
  vec3 color = textureLod(backdrop, clip.xy / clip.w * 0.5 + 0.5, lod).rgb;
  ${toLinearChunk("color")}
  return color;
}

// Light from behind the surface.
vec3 transmittedLight(vec3 viewPosition, vec3 normal, vec3 viewDirection, vec3 baseColor, float roughness) {
  float thick = surface.thickness * vShapeScale, lod = roughness * log2(float(textureSize(backdrop, 0).x));
  float spread = (indexOfRefraction - 1.0) * 0.025 * dispersion;
  vec3 light;
  for (int channel = 0; channel < 3; channel++) {
    float index = max(indexOfRefraction + spread * float(channel - 1), 1.0);
    light[channel] = backdropAt(viewPosition, thick * refract(-viewDirection, normal, 1.0 / index), lod)[channel];
  }
  vec3 transmittance = pow(max(attenuationColor, 1e-4), vec3(thick / attenuationDistance));
  float NV = clamp(dot(normal, viewDirection), 0.0, 1.0);
  return light * baseColor * transmittance * (1.0 - fresnelAt(NV)) * underLayers(NV, viewDirection);
}
`;

/**
 * GLSL that fills `surface` before the lights. `ifTexture` returns GLSL that is compiled where there is a texture of
 * this role; `use` is called with the expressions of its texel and of its coordinates. `tangentUv`: coordinates along
 * which a surface is anisotropic.
 */
export function extendedSurface(
  ifTexture: (role: ExtensionTextureRole, use: (texel: string, uv: string) => string) => string,
  tangentUv: string,
): string {
  return /* glsl */ `
float strength = anisotropyStrength;
vec2 direction = vec2(cos(anisotropyRotation), sin(anisotropyRotation));
float specularWeight = reflectionStrength;
vec3 specularTint = specularColor;
surface.sheen = sheenColor;
surface.sheenRoughness = sheenRoughness;
surface.coat = clearcoat;
surface.coatRoughness = clearcoatRoughness;
surface.film = iridescence;
surface.filmThickness = iridescenceThicknessMaximum;
surface.transmission = transmission;
surface.thickness = thickness;
surface.coatNormal = faceNormal;
mat2x3 tangents = tangentsOf(normal, ${tangentUv});
${ifTexture(
  "anisotropy",
  (texel) => `
  vec3 anisotropyTexel = ${texel}.rgb;
  direction = mat2(direction, -direction.y, direction.x) * (anisotropyTexel.rg * 2.0 - 1.0);
  strength *= anisotropyTexel.b;`,
)}
${ifTexture(
  "clearcoatNormal",
  (texel, uv) => `
  vec3 coatTexel = ${texel}.xyz * 2.0 - 1.0;
  surface.coatNormal = normalize(mat3(tangentsOf(faceNormal, ${uv})[0], tangentsOf(faceNormal, ${uv})[1], faceNormal) * coatTexel);`,
)}
${ifTexture("clearcoat", (texel) => `surface.coat *= ${texel}.r;`)}
${ifTexture("clearcoatRoughness", (texel) => `surface.coatRoughness *= ${texel}.g;`)}
${ifTexture("iridescence", (texel) => `surface.film *= ${texel}.r;`)}
${ifTexture("iridescenceThickness", (texel) => `surface.filmThickness = mix(iridescenceThicknessMinimum, iridescenceThicknessMaximum, ${texel}.g);`)}
${ifTexture("sheenColor", (texel) => `vec3 sheenTexel = ${texel}.rgb; ${toLinearChunk("sheenTexel")} surface.sheen *= sheenTexel;`)}
${ifTexture("sheenRoughness", (texel) => `surface.sheenRoughness *= ${texel}.a;`)}
${ifTexture("specularStrength", (texel) => `specularWeight *= ${texel}.a;`)}
${ifTexture("specularColor", (texel) => `vec3 specularTexel = ${texel}.rgb; ${toLinearChunk("specularTexel")} specularTint *= specularTexel;`)}
${ifTexture("transmission", (texel) => `surface.transmission *= ${texel}.r;`)}
${ifTexture("thickness", (texel) => `surface.thickness *= ${texel}.g;`)}
surface.transmission *= 1.0 - material.metallic;
vec3 dielectric = min(square((indexOfRefraction - 1.0) / (indexOfRefraction + 1.0)) * specularTint, 1.0) * specularWeight;
surface.f0 = mix(dielectric, material.diffuseColor, material.metallic);
surface.f90 = vec3(mix(specularWeight, 1.0, material.metallic));
surface.tangent = tangents * normalize(direction + vec2(1e-6, 0.0));
surface.bitangent = cross(normal, surface.tangent);
surface.alphaT = mix(square(material.roughness), 1.0, strength * strength);
totalEmissiveRadiance *= underLayers(clamp(dot(normal, normalize(vViewPosition)), 0.0, 1.0), normalize(vViewPosition));
`;
}

/** Adds the light from behind the surface to what it emits, after the lights. */
export const transmissionChunk = /* glsl */ `
if (surface.transmission > 0.0)
  totalEmissiveRadiance += surface.transmission *
    transmittedLight(-vViewPosition, normal, normalize(vViewPosition), diffuseColor.rgb, material.roughness);
`;
