// The textures of X3D 4's materials (ISO/IEC 19775-1:2023, 12.2). Each texture is multiplied by
// the field that it belongs to; the normal texture perturbs the surface normal. Colour textures have
// display (sRGB) values; a PhysicalMaterial converts them to linear ones before it computes light.
// The values of other textures are not converted.

import type { MeshBasicMaterial, MeshPhongMaterial, Texture } from "three";
import type { AppearanceDescription } from "../../document/description.ts";
import { cubeMapDirections } from "../../document/description.ts";
import { toLinearChunk } from "../../lighting/physicalLighting.ts";
import { instancesDefine } from "../shaders/instanceRecord.ts";
import { glyphsDefine, setDefine } from "./defines.ts";
import type { SurfaceTextures } from "./surfaceTextures.ts";
import type { ExtraMapRole } from "../shaders/texCoords.ts";
import { extraMapDefine, extraMapRoles, extraTexel } from "../shaders/texCoords.ts";
import { srgbColorsDefine } from "../shaders/vertexFormat.ts";

/** Samplers of the textures for which three.js' Phong and basic materials have no map. */
export interface ExtraMapUniforms extends Readonly<Record<`${ExtraMapRole}Map`, { value: Texture | null }>> {
  readonly cubeMap: { value: Texture | null };
  /** Index of a CubeMapDirection. */
  readonly cubeMapDirection: { value: number };
}

export function makeExtraMapUniforms(): ExtraMapUniforms {
  const maps = Object.fromEntries(extraMapRoles.map((role) => [`${role}Map`, { value: null }]));
  return { ...(maps as unknown as ExtraMapUniforms), cubeMap: { value: null }, cubeMapDirection: { value: 0 } };
}

const linear = (color: string) => `
  #ifdef ${srgbColorsDefine}
    ${toLinearChunk(color)}
  #endif`;

const colorChunk = /* glsl */ `
#ifdef USE_MAP
  vec4 texel = texture2D(map, vMapUv);
  ${linear("texel.rgb")}
  #ifdef ${glyphsDefine}
    texel.rgb = vec3(1.0);
  #endif
  diffuseColor *= texel;
#endif
`;

const emissiveChunk = /* glsl */ `
#ifdef USE_EMISSIVEMAP
  vec3 emissiveTexel = texture2D(emissiveMap, vEmissiveMapUv).rgb;
  ${linear("emissiveTexel")}
  totalEmissiveRadiance *= emissiveTexel;
#endif
`;

const occlusionChunk = /* glsl */ `
#include <aomap_fragment>
#ifdef USE_AOMAP
  reflectedLight.indirectSpecular *= ambientOcclusion;
#endif
`;

const cubeMapDefine = "USE_CUBE_MAP";

/** Reads the cube map after the normal is known: it is multiplied by the main color. */
const cubeMapChunk = /* glsl */ `
#ifdef ${cubeMapDefine}
  vec3 cubeDirection = reflect(-normalize(vViewPosition), normal);
  if (cubeMapDirection == ${cubeMapDirections.indexOf("reflection")}) cubeDirection = cubeDirection * mat3(viewMatrix);
  if (cubeMapDirection == ${cubeMapDirections.indexOf("cameraNormal")}) cubeDirection = normal;
  if (cubeMapDirection == ${cubeMapDirections.indexOf("cameraPosition")}) cubeDirection = -vViewPosition;
  vec3 cubeTexel = textureCube(cubeMap, cubeDirection).rgb;
  ${linear("cubeTexel")}
  diffuseColor.rgb *= cubeTexel;
#endif
`;

/** Declarations at the head of a fragment shader. */
export const cubeMapDeclarations = /* glsl */ `
#ifdef ${cubeMapDefine}
  uniform samplerCube cubeMap;
  uniform int cubeMapDirection;
#endif
`;

/** Defined in materials that ignore light. */
export const unlitDefine = "UNLIT";

/** Fills `X3dMaterial material`, from which the lighting functions compute. */
export const x3dMaterialChunk = /* glsl */ `
${cubeMapChunk}
#ifdef ${unlitDefine}
  totalEmissiveRadiance = diffuseColor.rgb;
  X3dMaterial material = X3dMaterial(vec3(0.0), vec3(0.0), 1.0, vec3(0.0), 0.0, 1.0);
#elif defined(${instancesDefine})
  X3dMaterial material = X3dMaterial(
    diffuseColor.rgb, instanceSpecular.rgb, instanceSpecular.a, vec3(instanceEmissive.a), instanceSpecular.r, instanceSpecular.g);
#else
  X3dMaterial material = X3dMaterial(
    diffuseColor.rgb, specular, shininess, vec3(ambientIntensity), metallic, roughness);
#endif
#ifdef USE_SPECULARMAP
  material.specularColor *= texture2D(specularMap, vSpecularMapUv).rgb;
#endif
#ifdef ${extraMapDefine("shininess")}
  material.shininess *= ${extraTexel("shininess")}.a;
#endif
#ifdef ${extraMapDefine("ambient")}
  material.ambient *= ${extraTexel("ambient")}.rgb;
#endif
#ifdef ${extraMapDefine("metallicRoughness")}
  vec4 metallicRoughnessTexel = ${extraTexel("metallicRoughness")};
  material.roughness *= metallicRoughnessTexel.g;
  material.metallic *= metallicRoughnessTexel.b;
#endif
`;

export const textureMapChunks: readonly (readonly [string, string])[] = [
  ["#include <map_fragment>", colorChunk],
  ["#include <emissivemap_fragment>", emissiveChunk],
  ["#include <specularmap_fragment>", "float specularStrength = 1.0;"],
  ["#include <aomap_fragment>", occlusionChunk],
];

type Slot = "map" | "emissiveMap" | "normalMap" | "aoMap" | "specularMap";

/** Sets the texture maps of a material; when a map is added or removed, three.js compiles another program. */
export function setTextureMaps(
  material: MeshPhongMaterial | MeshBasicMaterial,
  { material: description, cubeMap }: Pick<AppearanceDescription, "material" | "cubeMap">,
  surfaceTextures: SurfaceTextures,
  extraMaps: ExtraMapUniforms | undefined,
): void {
  const textureOf = (role: Parameters<SurfaceTextures["get"]>[0]) => surfaceTextures.get(role)?.texture ?? null;
  setMap(material, "map", textureOf("color"));
  if (!("emissiveMap" in material) || extraMaps === undefined) return;
  setMap(material, "emissiveMap", textureOf("emissive"));
  setMap(material, "normalMap", textureOf("normal"));
  setMap(material, "aoMap", textureOf("occlusion"));
  setMap(material, "specularMap", description.kind === "phong" ? textureOf("specular") : null);
  if (description.kind !== "unlit") {
    material.normalScale.set(description.normalScale, description.normalScale);
    material.aoMapIntensity = description.occlusionStrength;
  }
  extraMaps.cubeMap.value = textureOf("cubeMap");
  extraMaps.cubeMapDirection.value = cubeMapDirections.indexOf(cubeMap?.direction ?? "reflection");
  setDefine(material, cubeMapDefine, extraMaps.cubeMap.value !== null);
  for (const role of extraMapRoles) setExtraMap(material, role, textureOf(role), extraMaps);
}

function setMap(material: MeshPhongMaterial | MeshBasicMaterial, slot: Slot, texture: Texture | null): void {
  const maps = material as Record<Slot, Texture | null>;
  if ((maps[slot] === null) !== (texture === null)) material.needsUpdate = true;
  maps[slot] = texture;
}

function setExtraMap(
  material: MeshPhongMaterial,
  role: ExtraMapRole,
  texture: Texture | null,
  uniforms: ExtraMapUniforms,
): void {
  uniforms[`${role}Map`].value = texture;
  setDefine(material, extraMapDefine(role), texture !== null);
}
