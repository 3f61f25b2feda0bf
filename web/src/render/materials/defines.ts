// Changing the #defines of a material.

import type { Material } from "three";

/** Defined in materials whose map is the distance field of glyphs. */
export const glyphsDefine = "GLYPHS";

/** Adds or removes a #define; three.js then compiles another program where that changes something. */
export function setDefine(material: Material, name: string, isDefined: boolean): void {
  const defines = material.defines ?? {};
  if (name in defines === isDefined) return;
  const others = Object.entries(defines).filter(([other]) => other !== name);
  material.defines = { ...Object.fromEntries(others), ...(isDefined && { [name]: "" }) };
  material.needsUpdate = true;
}
