// The BatchingRules of X3D materials: which appearances can share a batch, and which of their values
// are in the instance records.

import type { AppearanceDescription } from "../../document/description.ts";
import { isBlended, unlitColorOf, opacityOf, litParametersOf } from "../../lighting/materialParameters.ts";
import { isTransmissive } from "./extendedMaterials.ts";
import { isLine } from "../primitives/primitives.ts";
import type { VertexColors, MaterialRequest, Shading } from "./materialFactory.ts";
import type { SurfaceTextures } from "./surfaceTextures.ts";

/** Whether a draw is blended: by the material, vertex colours or the colour texture. */
export function isDrawBlended(
  appearance: AppearanceDescription,
  colors: VertexColors,
  surfaceTextures: SurfaceTextures,
): boolean {
  if (isTransmissive(appearance.material)) return true; // what is behind it must be drawn before it
  return isBlended(appearance, colors === "rgba" || surfaceTextures.get("color")?.hasAlpha === true);
}

/** BatchingRules.materialKeyOf for X3D materials. */
export function materialKeyOf(
  { primitive, colors }: Pick<MaterialRequest, "primitive" | "colors">,
  appearance: AppearanceDescription,
  surfaceTextures: SurfaceTextures,
): string {
  const { material, points, lines, colorMap, ...rest } = appearance;
  const others = Object.entries(material).filter(([name]) => !instanceFieldNames.has(name));
  return JSON.stringify([
    isDrawBlended(appearance, colors, surfaceTextures),
    rest,
    others,
    Array.from(surfaceTextures, ([role, { texture }]) => [role, texture.uuid]).sort(),
    primitive === "points" && points,
    isLine({ primitive }) && lines?.dashes,
    colorMap?.colors,
  ]);
}

/** The material fields that `instanceNumbersOf` returns; the material key leaves them out. */
const instanceFieldNames = new Set([
  "diffuseColor",
  "baseColor",
  "specularColor",
  "shininess",
  "emissiveColor",
  "ambientIntensity",
  "metallic",
  "roughness",
  "transparency",
]);

/** BatchingRules.instanceNumbersOf for X3D materials. */
export function instanceNumbersOf(
  { shading, colors }: { shading: Shading; colors: VertexColors },
  appearance: AppearanceDescription,
): readonly number[] {
  const { material, colorMap: { range } = { range: [0, 1] }, lines: { width } = { width: 0 } } = appearance;
  const opacity = opacityOf(appearance);
  if (isUnlit(shading))
    return [...unlitColorOf(material, colors !== "none"), opacity, 0, 0, 0, 0, 0, 0, 0, 0, ...range, width];
  const { color, specular, shininess, ambientIntensity, metallic, roughness } = litParametersOf(
    material,
    colors !== "none",
  );
  const reflection = material.kind === "physical" ? [metallic, roughness, 0, 0] : [...specular, shininess];
  return [...color, opacity, ...reflection, ...material.emissiveColor, ambientIntensity, ...range, width];
}

/** Whether light has no effect. */
export function isUnlit(shading: Shading): boolean {
  return shading === "unlit" || shading === "distance";
}
