// GLSL for the coordinates of a material's textures: three.js' maps, and extra maps for the
// textures of X3D for which three.js has none.

import { Matrix3 } from "three";
import type { AppearanceDescription, TextureRole } from "../../document/description.ts";
import { textureRoles } from "../../document/description.ts";
import { extensionRoles } from "../../lighting/extendedLighting.ts";

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
  ...extensionRoles,
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
uniform vec4 texCoordFrame;
uniform mat3 textureTransforms[${textureRoles.length}];
${extraMapVaryings("")}
`;

/** Declarations at the head of a fragment shader. */
export const extraMapDeclarations = extraMapVaryings("uniform sampler2D ");

/** Computes the coordinates of each texture, after `vertex` has been read. */
export const texCoordChunk = /* glsl */ `
vec4 frame = instanceTexCoordFrame();
vec3 shapeTexCoord = vec3(frame.xy + frame.zw * vertex.texCoord, 1.0);
${varyings
  .map(
    ([define, varying, role]) => `#ifdef ${define}
  ${varying} = (textureTransforms[${textureRoles.indexOf(role)}] * shapeTexCoord).xy;
#endif`,
  )
  .join("\n")}
`;

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

/** Matrices by texture role; the identity where the appearance has no such texture. */
export function textureTransformsOf({ textures }: Pick<AppearanceDescription, "textures">): Matrix3[] {
  return textureRoles.map((role) => {
    const texture = textures.find((each) => each.role === role);
    return texture ? new Matrix3().fromArray(texture.transform) : new Matrix3();
  });
}
