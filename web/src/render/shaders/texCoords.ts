// GLSL for the coordinates of a material's textures: three.js' maps, and extra maps for the
// textures of X3D for which three.js has none.

import { Matrix3 } from "three";
import type { AppearanceDescription, GeometryDescription, TextureRole } from "../../document/description.ts";
import { extensionTextureRoles, textureRoles } from "../../document/description.ts";
import { attributeRows, texCoordRoles } from "../../stage/attributeRows.ts";

/** Per map: the #define that three.js sets for it, the varying for its coordinates, and the texture role. */
const maps: readonly (readonly [define: string, varying: string, role: TextureRole])[] = [
  ["USE_MAP", "vMapUv", "color"],
  ["USE_EMISSIVEMAP", "vEmissiveMapUv", "emissive"],
  ["USE_NORMALMAP", "vNormalMapUv", "normal"],
  ["USE_AOMAP", "vAoMapUv", "occlusion"],
  ["USE_SPECULARMAP", "vSpecularMapUv", "specular"],
  ["USE_METALNESSMAP", "vMetalnessMapUv", "metallicRoughness"],
  ["USE_ROUGHNESSMAP", "vRoughnessMapUv", "metallicRoughness"],
];

/** Roles for which three.js' Phong and basic materials have no map; their samplers are called `<role>Map`. */
export const extraMapRoles = [
  "metallicRoughness",
  "ambient",
  "shininess",
  ...extensionTextureRoles,
] as const satisfies readonly TextureRole[];
export type ExtraMapRole = (typeof extraMapRoles)[number];

export function extraMapDefine(role: ExtraMapRole): string {
  return `USE_EXTRA_${role.toUpperCase()}`;
}

/** The GLSL expression of the coordinates of an extra map, in a fragment shader. */
export function extraUv(role: ExtraMapRole): string {
  return `v_${role}Uv`;
}

/** The GLSL expression of the texel of an extra map, in a fragment shader. */
export function extraTexel(role: ExtraMapRole): string {
  return `texture2D(${role}Map, ${extraUv(role)})`;
}

/** Picking pass only: defined if the alpha of the colour texture discards fragments. */
export const alphaMaskDefine = "USE_ALPHA_MASK";
export const alphaMaskVarying = "vAlphaMaskUv";

const varyings = [
  ...maps,
  [alphaMaskDefine, alphaMaskVarying, "color"] as const,
  ...extraMapRoles.map((role) => [extraMapDefine(role), `v_${role}Uv`, role] as const),
];

/** Declarations at the head of a vertex shader. */
export const texCoordDeclarations = /* glsl */ `
uniform vec4 texCoordFrames[${texCoordRoles.length}];
uniform mat3 textureTransforms[${textureRoles.length}];
uniform int textureSets[${textureRoles.length}];
${extraMapVaryings("")}
`;

/** Declarations at the head of a fragment shader. */
export const extraMapDeclarations = extraMapVaryings("uniform sampler2D ");

/** Computes the coordinates of each texture, after `vertex` has been read. */
export const texCoordChunk = /* glsl */ `
vec3 shapeTexCoords[${texCoordRoles.length}];
${texCoordRoles.map(shapeTexCoordChunk).join("\n")}
${varyings
  .map(
    ([define, varying, role]) => `#ifdef ${define}
  ${varying} = (textureTransforms[${textureRoles.indexOf(role)}] * shapeTexCoords[textureSets[${textureRoles.indexOf(role)}]]).xy;
#endif`,
  )
  .join("\n")}
`;

function shapeTexCoordChunk(role: (typeof texCoordRoles)[number], set: number): string {
  return /* glsl */ `
#ifdef ${attributeRows[role].define ?? ""}
  vec4 frame${set} = instanceTexCoordFrame(${set});
  shapeTexCoords[${set}] = vec3(frame${set}.xy + frame${set}.zw * vertex.${role}, 1.0);
#else
  shapeTexCoords[${set}] = vec3(0.0, 0.0, 1.0);
#endif`;
}

function extraMapVaryings(sampler: string): string {
  return extraMapRoles
    .map(
      (role) => `#ifdef ${extraMapDefine(role)}
  varying vec2 v_${role}Uv;
  ${sampler === "" ? "" : `${sampler}${role}Map;`}
#endif`,
    )
    .join("\n");
}

/** The origin and the extent of each set of texture coordinates, two numbers each. */
export function texCoordFramesOf({ texCoordBoxes }: Pick<GeometryDescription, "texCoordBoxes">): number[] {
  return texCoordBoxes.flatMap(({ min, size }) => [...min, ...size]);
}

/** Sets of texture coordinates by texture role; 0 where the appearance has no such texture. */
export function textureSetsOf({ textures }: Pick<AppearanceDescription, "textures">): number[] {
  return textureRoles.map((role) => textures.find((each) => each.role === role)?.texCoordSet ?? 0);
}

/** Matrices by texture role; the identity where the appearance has no such texture. */
export function textureTransformsOf({ textures }: Pick<AppearanceDescription, "textures">): Matrix3[] {
  return textureRoles.map((role) => {
    const texture = textures.find((each) => each.role === role);
    return texture ? new Matrix3().fromArray(texture.transform) : new Matrix3();
  });
}
