// The appearance of a shape as plain data: its material, textures, points, lines and color map.

import type { Vec2, Vec3 } from "./fieldTypes.ts";
import type { ImageDescription } from "./imageDescription.ts";
import type { AppearanceCubeMap } from "./panoramaDescription.ts";
import type { Operator } from "./operators.ts";
import type { nodeFields, Values } from "./nodes.ts";

/**
 * The fields of a PhysicalMaterial's extensions, with the defaults of those that it lacks. The strength of emission is
 * a factor of the material's emissiveColor already.
 */
export type MaterialExtensions = Values<typeof nodeFields.AnisotropyMaterialExtension> &
  Values<typeof nodeFields.ClearcoatMaterialExtension> &
  Values<typeof nodeFields.DispersionMaterialExtension> &
  Values<typeof nodeFields.IORMaterialExtension> &
  Values<typeof nodeFields.IridescenceMaterialExtension> &
  Values<typeof nodeFields.SheenMaterialExtension> &
  Values<typeof nodeFields.SpecularMaterialExtension> &
  Values<typeof nodeFields.TransmissionMaterialExtension> &
  Values<typeof nodeFields.VolumeMaterialExtension>;

/** X3D's Phong model, lit in sRGB; glTF's metallic-roughness model, lit in linear color; or an unlit color. */
export type MaterialDescription =
  | ({ readonly kind: "phong" } & Values<typeof nodeFields.Material>)
  | ({
      readonly kind: "physical";
      /** Undefined: the material has none. */
      readonly extensions?: MaterialExtensions | undefined;
    } & Values<typeof nodeFields.PhysicalMaterial>)
  | ({ readonly kind: "unlit" } & Values<typeof nodeFields.UnlitMaterial>);

/** The meaning of alpha. AUTO blends where the material or a texture is transparent. */
export interface AlphaDescription {
  readonly mode: "AUTO" | "OPAQUE" | "MASK" | "BLEND";
  /** MASK only: fragments with a lower alpha are not drawn. */
  readonly cutoff: number;
}

/** 3 x 3, column by column. */
export type TextureMatrix = readonly [number, number, number, number, number, number, number, number, number];

/** The roles of the textures of PhysicalMaterial's extensions. */
export const extensionTextureRoles = [
  "anisotropy",
  "clearcoat",
  "clearcoatRoughness",
  "clearcoatNormal",
  "iridescence",
  "iridescenceThickness",
  "sheenColor",
  "sheenRoughness",
  "specularStrength",
  "specularColor",
  "transmission",
  "thickness",
] as const;
export type ExtensionTextureRole = (typeof extensionTextureRoles)[number];

/**
 * The material property that a texture modulates. `color` is diffuseColor, baseColor or an UnlitMaterial's
 * emissiveColor.
 */
export const textureRoles = [
  "color",
  "emissive",
  "metallicRoughness",
  "normal",
  "occlusion",
  "ambient",
  "specular",
  "shininess",
  ...extensionTextureRoles,
] as const;
export type TextureRole = (typeof textureRoles)[number];

export interface TextureDescription extends ImageDescription {
  readonly role: TextureRole;
  /** Maps a vertex's texture coordinates to the image's. */
  readonly transform: TextureMatrix;
  /** As written: the name of a set of texture coordinates, and of a transform; empty: the first. */
  readonly mapping: string;
  /** The set of texture coordinates of the shape's geometry that `mapping` names. */
  readonly texCoordSet: number;
}

/** X3D's PointProperties, in CSS pixels. */
export interface PointDescription {
  readonly size: number;
  readonly minSize: number;
  readonly maxSize: number;
  /** The size at distance r is divided by a + b r + c r². */
  readonly attenuation: Vec3;
}

/** X3D's LineProperties, for lines that are wider than one pixel or dashed. */
export interface LineDescription {
  /** In CSS pixels. */
  readonly width: number;
  /** Alternating lengths of dashes and gaps, in line widths, an even number of them; empty for a solid line. */
  readonly dashes: readonly number[];
}

/** Maps values to colors: the first color at the beginning of the range, the last at its end. */
export interface ColorMapDescription {
  readonly colors: readonly Vec3[];
  readonly range: Vec2;
  /** Whether the live stream that has the values states the range (attributes.ts, withStreamedRange). */
  readonly isRangeStreamed?: boolean;
}

export interface AppearanceDescription {
  readonly material: MaterialDescription;
  readonly alpha: AlphaDescription;
  /** At most one of each role. */
  readonly textures: readonly TextureDescription[];
  readonly cubeMap?: AppearanceCubeMap | undefined;
  readonly points: PointDescription | undefined;
  /** Undefined: thin solid lines. */
  readonly lines: LineDescription | undefined;
  /** Replaces the material's diffuse color where the geometry's vertices have values. */
  readonly colorMap: ColorMapDescription | undefined;
  /** What maps the vertices of the geometry; absent: nothing. Here because a change of it needs no other vertices. */
  readonly operators?: readonly Operator[];
}
