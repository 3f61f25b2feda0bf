// Computes the parameters of the lighting equations from a material's fields.

import type { AppearanceDescription, MaterialDescription, Vec3 } from "../document/description.ts";
import { srgbOf } from "./physicalLighting.ts";

/**
 * Whether surfaces are blended with what is behind them. `hasAlpha`: whether vertex colours or the colour texture have
 * alpha.
 */
export function isBlended(
  { alpha: { mode }, material: { transparency } }: AppearanceDescription,
  hasAlpha: boolean,
): boolean {
  return mode === "BLEND" || (mode === "AUTO" && (transparency > 0 || hasAlpha));
}

export function opacityOf({ alpha: { mode }, material: { transparency } }: AppearanceDescription): number {
  return mode === "OPAQUE" ? 1 : 1 - transparency;
}

/**
 * The colour of unlit points and lines: vertex colours, else the emissive colour as in X3D, else the diffuse colour,
 * since scans without an emissive colour would be black on black.
 */
export function unlitColorOf(description: MaterialDescription, hasColors: boolean): Vec3 {
  if (hasColors) return [1, 1, 1];
  const { emissiveColor } = description;
  const isDark = emissiveColor.every((channel) => channel === 0);
  switch (description.kind) {
    case "phong":
      return isDark ? description.diffuseColor : emissiveColor;
    case "physical":
      // Colours of PhysicalMaterial are linear.
      return srgbOf(isDark ? description.baseColor : emissiveColor);
    case "unlit":
      return emissiveColor;
  }
}

export interface LitParameters {
  readonly color: Vec3;
  readonly specular: Vec3;
  /** The exponent of the specular term. */
  readonly shininess: number;
  readonly ambientIntensity: number;
  readonly metallic: number;
  readonly roughness: number;
}

/**
 * The parameters of a lit material. Vertex colours replace the diffuse colour of a Material; the base colour of a
 * PhysicalMaterial is multiplied by them, as in glTF.
 */
export function litParametersOf(description: MaterialDescription, hasColors: boolean): LitParameters {
  switch (description.kind) {
    case "physical":
      return {
        ...blackParameters,
        color: description.baseColor,
        metallic: description.metallic,
        roughness: description.roughness,
      };
    case "phong": {
      const { diffuseColor, specularColor, shininess, ambientIntensity } = description;
      return {
        color: hasColors ? [1, 1, 1] : diffuseColor,
        specular: specularColor,
        shininess: shininess * 128,
        ambientIntensity,
        metallic: 1,
        roughness: 1,
      };
    }
    case "unlit":
      return { ...blackParameters, color: unlitColorOf(description, hasColors) };
  }
}

const blackParameters: LitParameters = {
  color: [0, 0, 0],
  specular: [0, 0, 0],
  shininess: 0,
  ambientIntensity: 0,
  metallic: 1,
  roughness: 1,
};
