// Texture coordinates of a material's textures: three.js' maps, and further ones that three.js has
// no map for.

import { Matrix3 } from "three";
import type { AppearanceDescription, TextureRole } from "../../document/description.ts";
import { textureRoles } from "../../document/description.ts";

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

/** Roles without a map in three.js' Phong and basic materials; their samplers are called `<role>Map`. */
export const ownMapRoles = ["metallicRoughness", "ambient", "shininess"] as const satisfies readonly TextureRole[];
export type OwnMapRole = (typeof ownMapRoles)[number];

export function ownMapDefine(role: OwnMapRole): string {
  return `USE_OWN_${role.toUpperCase()}`;
}

/** GLSL that samples such a texture, in a fragment shader. */
export function ownTexel(role: OwnMapRole): string {
  return `texture2D(${role}Map, v_${role}Uv)`;
}

/** In the picking pass: the texture whose alpha masks the surface. */
export const alphaMaskDefine = "USE_ALPHA_MASK";
export const alphaMaskVarying = "vAlphaMaskUv";

const all = [
  ...maps,
  [alphaMaskDefine, alphaMaskVarying, "color"] as const,
  ...ownMapRoles.map((role) => [ownMapDefine(role), `v_${role}Uv`, role] as const),
];

/** For the head of a vertex shader. */
export const texCoordDeclarations = /* glsl */ `
uniform vec4 texCoordFrame;
uniform mat3 textureTransforms[${textureRoles.length}];
${ownVaryings("")}
`;

/** For the head of a fragment shader. */
export const ownMapDeclarations = ownVaryings("uniform sampler2D ");

/** After `vertex` has been read. */
export const texCoordChunk = /* glsl */ `
vec4 frame = instanceTexCoordFrame();
vec3 shapeTexCoord = vec3(frame.xy + frame.zw * vertex.texCoord, 1.0);
${all
  .map(
    ([define, varying, role]) => `#ifdef ${define}
  ${varying} = (textureTransforms[${textureRoles.indexOf(role)}] * shapeTexCoord).xy;
#endif`,
  )
  .join("\n")}
`;

function ownVaryings(sampler: string): string {
  return ownMapRoles
    .map(
      (role) => `#ifdef ${ownMapDefine(role)}
  varying vec2 v_${role}Uv;
  ${sampler === "" ? "" : `${sampler}${role}Map;`}
#endif`,
    )
    .join("\n");
}

/** Matrices by texture role; the identity where the appearance has no such texture. */
export function textureTransformsOf({ textures }: Pick<AppearanceDescription, "textures">): Matrix3[] {
  return textureRoles.map((role) => {
    const texture = textures.find((each) => each.role === role);
    return texture ? new Matrix3().fromArray(texture.transform) : new Matrix3();
  });
}
