// Reads X3D's Text: a rectangle for each run of glyphs, and the glyph atlas as its texture.

import { geometryOfArrays } from "../document/arrayGeometry.ts";
import type { AppearanceDescription, TextureDescription, Warning } from "../document/description.ts";
import type { SceneElement } from "../document/element.ts";
import { childrenOf, emptyElement, lowerNameOf } from "../document/element.ts";
import type { TextReader } from "../document/textReader.ts";
import type { GlyphAtlas } from "./glyphAtlas.ts";
import { hasInk, glyphAtlasOf, glyphAtlasUrl } from "./glyphAtlas.ts";
import type { Values } from "../document/nodes.ts";
import { nodeFields, readFields } from "../document/nodes.ts";
import type { Alignment, Font, MeasureRun, PositionedRun, TextStyle } from "./textLayout.ts";
import { alignments, layOut } from "./textLayout.ts";

/**
 * `measure` measures runs of text. `editionOf` tells how many times faces of a font have loaded: another edition makes
 * another glyph atlas URL.
 */
export function textReader(measure: MeasureRun, editionOf: (font: Font, text: string) => number = () => 0): TextReader {
  const geometryOf: TextReader["geometryOf"] = (element, resolve, warnings) => {
    const { string, length, maxExtent, solid } = readFields(element, nodeFields.Text, warnings);
    const fontStyle = childrenOf(element)
      .flatMap((child) => resolve(child) ?? [])
      .find((child) => lowerNameOf(child) === "fontstyle");
    const fields = readFields(fontStyle ?? emptyElement, nodeFields.FontStyle, warnings);
    if (fields.size <= 0) {
      warnings.push({
        element,
        message: `size="${fields.size}" of its FontStyle is no font size; nothing is drawn`,
      });
      return undefined;
    }
    const style = styleOf(fields);
    const runs = layOut(
      string,
      length.map((each) => each / fields.size),
      maxExtent / fields.size,
      style,
      measure,
    );
    const atlas = glyphAtlasOf(runs);
    if (atlas === undefined) {
      warnings.push({ element, message: "has more characters than one glyph atlas holds; nothing is drawn" });
      return undefined;
    }
    const geometry = geometryOfArrays(rectanglesOf(runs, atlas, fields.size), solid);
    return (
      geometry && { ...geometry, glyphAtlas: glyphAtlasUrl(atlas, style.font, editionOf(style.font, string.join(""))) }
    );
  };
  return { geometryOf, appearanceOf: withGlyphAtlas };
}

function styleOf(fields: Values<typeof nodeFields.FontStyle>): TextStyle {
  const { family, justify, spacing, horizontal, leftToRight, topToBottom } = fields;
  const [major, minor] = justify.map(
    (word): Alignment => alignments.find((alignment) => alignment === word.trim().toUpperCase()) ?? "BEGIN",
  );
  return {
    font: fontOf(family, fields["data-style"] || fields.style),
    spacing,
    horizontal,
    leftToRight,
    topToBottom,
    major: major ?? "BEGIN",
    minor: minor ?? "FIRST",
  };
}

/** X3D's generic font families in CSS. */
const families: Readonly<Record<string, string>> = { SERIF: "serif", SANS: "sans-serif", TYPEWRITER: "monospace" };

function fontOf(family: readonly string[], style: string): Font {
  const isGeneric = (name: string) => name.trim().toUpperCase() in families;
  const generic = family.findIndex(isGeneric);
  const named = (generic < 0 ? family : family.slice(0, generic))
    .map((name) => name.trim())
    .filter((name) => /^[\w -]+$/.test(name));
  // Families after a generic one are dropped: Chromium would take the last of them.
  const last = families[family[generic]?.trim().toUpperCase() ?? ""] ?? "serif";
  return {
    family: [...named.map((name) => `"${name}"`), last].join(", "),
    isBold: /^BOLD/i.test(style.trim()),
    isItalic: /ITALIC$/i.test(style.trim()),
  };
}

/** Two triangles for each run, which cover its cell of the atlas and face +z. */
function rectanglesOf(
  runs: readonly PositionedRun[],
  { cells, width, height, texelsPerEm }: GlyphAtlas,
  size: number,
): Parameters<typeof geometryOfArrays>[0] {
  const positions: number[] = [],
    texCoords: number[] = [];
  for (const { text, x, y, stretchX, stretchY } of runs.filter(hasInk)) {
    const cell = cells.get(text);
    if (cell === undefined) continue;
    for (const [s, t] of [
      [0, 0],
      [1, 0],
      [1, 1],
      [0, 0],
      [1, 1],
      [0, 1],
    ] as const) {
      const [across, down] = [cell.left + s * cell.width, cell.top + (1 - t) * cell.height];
      positions.push(
        size * (x + (stretchX * (across - cell.penX)) / texelsPerEm),
        size * (y + (stretchY * (cell.penY - down)) / texelsPerEm),
        0,
      );
      texCoords.push(across / width, 1 - down / height);
    }
  }
  return {
    primitive: "triangles",
    colorComponents: 3,
    colors: undefined,
    positions: Float32Array.from(positions),
    texCoords: Float32Array.from(texCoords),
    normals: Float32Array.from(positions, (_, i) => (i % 3 === 2 ? 1 : 0)),
  };
}

/** The shape's appearance with the glyph atlas as its color texture, which replaces other textures. */
function withGlyphAtlas(
  appearance: AppearanceDescription,
  glyphAtlas: string,
  element: SceneElement,
  warnings: Warning[],
): AppearanceDescription {
  if (appearance.textures.length > 0) warnings.push({ element, message: "is a text: its textures are not shown" });
  const texture: TextureDescription = {
    role: "color",
    urls: [glyphAtlas],
    preview: "",
    transform: [1, 0, 0, 0, 1, 0, 0, 0, 1],
    mapping: "",
    texCoordSet: 0,
    sampling: {
      isData: false,
      wrapS: "clamp",
      wrapT: "clamp",
      isSmooth: true,
      hasMipmaps: true,
      anisotropy: 8,
      isDistanceField: true,
    },
  };
  return { ...appearance, alpha: { mode: "BLEND", cutoff: appearance.alpha.cutoff }, textures: [texture] };
}
