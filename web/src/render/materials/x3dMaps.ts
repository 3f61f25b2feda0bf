// The textures of X3D 4's materials (ISO/IEC 19775-1:2023, 12.2). Each is multiplied by the field
// beside it; the normal texture perturbs the surface normal. Colour textures are in display (sRGB)
// values, which a PhysicalMaterial, being lit in linear space, converts first. Other textures are
// data and taken as they are.

import type { MeshBasicMaterial, MeshPhongMaterial, Texture } from "three";
import type { MaterialDescription } from "../../document/description.ts";
import { toLinearChunk } from "../../lighting/physicalLighting.ts";
import { instancesDefine } from "../shaders/instanceRecord.ts";
import { setDefine } from "./defines.ts";
import type { SurfaceTextures } from "./surfaceTextures.ts";
import type { OwnMapRole } from "../shaders/texCoords.ts";
import { ownMapDeclarations, ownMapDefine, ownMapRoles, ownTexel } from "../shaders/texCoords.ts";
import { srgbColorsDefine } from "../shaders/vertexFormat.ts";

/** Samplers of textures that three.js' materials have no map for. */
export type OwnMapUniforms = Readonly<Record<`${OwnMapRole}Map`, { value: Texture | null }>>;

export function makeOwnMapUniforms(): OwnMapUniforms {
  return { metallicRoughnessMap: { value: null }, ambientMap: { value: null }, shininessMap: { value: null } };
}

const linear = (color: string) => `
  #ifdef ${srgbColorsDefine}
    ${toLinearChunk(color)}
  #endif`;

const colorChunk = /* glsl */ `
#ifdef USE_MAP
  vec4 texel = texture2D(map, vMapUv);
  ${linear("texel.rgb")}
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

/** Defined in materials that ignore light. */
export const unlitDefine = "UNLIT";

/** Fills `X3dMaterial material`, from which the lighting functions compute. */
export const x3dMaterialChunk = /* glsl */ `
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
#ifdef ${ownMapDefine("shininess")}
  material.shininess *= ${ownTexel("shininess")}.a;
#endif
#ifdef ${ownMapDefine("ambient")}
  material.ambient *= ${ownTexel("ambient")}.rgb;
#endif
#ifdef ${ownMapDefine("metallicRoughness")}
  vec4 metallicRoughnessTexel = ${ownTexel("metallicRoughness")};
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

export { ownMapDeclarations };

type Slot = "map" | "emissiveMap" | "normalMap" | "aoMap" | "specularMap";

/** Sets the texture maps of a material; three.js compiles another program where some have come or gone. */
export function setTextureMaps(
  material: MeshPhongMaterial | MeshBasicMaterial,
  description: MaterialDescription,
  surfaceTextures: SurfaceTextures,
  ownMaps: OwnMapUniforms | undefined,
): void {
  const textureOf = (role: Parameters<SurfaceTextures["get"]>[0]) => surfaceTextures.get(role)?.texture ?? null;
  setMap(material, "map", textureOf("color"));
  if (!("emissiveMap" in material) || ownMaps === undefined) return;
  setMap(material, "emissiveMap", textureOf("emissive"));
  setMap(material, "normalMap", textureOf("normal"));
  setMap(material, "aoMap", textureOf("occlusion"));
  setMap(material, "specularMap", description.kind === "phong" ? textureOf("specular") : null);
  if (description.kind !== "unlit") {
    material.normalScale.set(description.normalScale, description.normalScale);
    material.aoMapIntensity = description.occlusionStrength;
  }
  for (const role of ownMapRoles) setOwnMap(material, role, textureOf(role), ownMaps);
}

function setMap(material: MeshPhongMaterial | MeshBasicMaterial, slot: Slot, texture: Texture | null): void {
  const maps = material as Record<Slot, Texture | null>;
  if ((maps[slot] === null) !== (texture === null)) material.needsUpdate = true;
  maps[slot] = texture;
}

function setOwnMap(
  material: MeshPhongMaterial,
  role: OwnMapRole,
  texture: Texture | null,
  uniforms: OwnMapUniforms,
): void {
  uniforms[`${role}Map`].value = texture;
  setDefine(material, ownMapDefine(role), texture !== null);
}
