// Color maps for scalar values: a named map, or a list of equidistant colors.

import type { Field, FieldType, Vec3 } from "./fieldTypes.ts";
import { entryOf } from "./tables.ts";

/** The largest number of colors in a map: the length of the shader's uniform array. */
export const maxMapColors = 32;

const namedMaps: Readonly<Record<string, string>> = {
  // Smith and van der Walt 2015, "A better default colormap for matplotlib": perceptually uniform.
  viridis: "440154 482878 3e4989 31688e 26828e 1f9e89 35b779 6dcd59 b4de2c fde725",
  // Moreland 2009, "Diverging color maps for scientific visualization": diverging from a middle value.
  coolwarm: "3b4cc0 8db0fe dddddd f49a7b b40426",
  gray: "000000 ffffff",
};

function colorsOf(hexes: string): Vec3[] {
  return hexes
    .split(" ")
    .map((hex) => [0, 2, 4].map((start) => parseInt(hex.slice(start, start + 2), 16) / 255) as unknown as Vec3);
}

const colorMap: FieldType<readonly Vec3[]> = {
  name: `color map (${Object.keys(namedMaps).join(", ")}, or 2 to ${maxMapColors} colors)`,
  parse(text) {
    const known = entryOf(namedMaps, text.trim().toLowerCase());
    if (known !== undefined) return colorsOf(known);
    const words = text.split(/[\s,]+/).filter((word) => word !== "");
    const numbers = words.map(Number);
    const count = numbers.length / 3;
    if (!numbers.every(Number.isFinite) || !Number.isInteger(count) || count < 2 || count > maxMapColors)
      return undefined;
    return Array.from({ length: count }, (_, i) => numbers.slice(3 * i, 3 * i + 3) as unknown as Vec3);
  },
};

export const ColorMap = (name: string): Field<readonly Vec3[]> => ({
  type: colorMap,
  defaultValue: colorsOf(namedMaps[name] ?? ""),
});
