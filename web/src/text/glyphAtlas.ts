// The glyph atlas of a text: runs of text in rows of one image, each with a margin for the distance field. A data: URL
// describes the atlas; glyphRendering.ts draws it.

import { dataUrl } from "../document/dataUrl.ts";
import { fieldSpread } from "./fieldSpread.ts";
import type { Font, PositionedRun } from "./textLayout.ts";

/** Texels per em, best first: the first that fits is taken. With fewer than the last, text is illegible. */
const resolutions = [96, 64, 48, 32, 24, 16, 12];
/** Every GPU supports textures of this size. */
const maxEdge = 2048;
/** Computing the distance field of so many texels takes some 50 ms. */
const maxTexels = 2 ** 18;

/**
 * The rectangle of a run in the atlas, in texels from the upper left corner; the pen is at the start of the run's
 * baseline.
 */
export interface GlyphCell {
  readonly left: number;
  readonly top: number;
  readonly width: number;
  readonly height: number;
  readonly penX: number;
  readonly penY: number;
}

export interface GlyphAtlas {
  readonly width: number;
  readonly height: number;
  readonly texelsPerEm: number;
  readonly cells: ReadonlyMap<string, GlyphCell>;
}

/** Packs a cell for each distinct text with ink; undefined where they do not fit. */
export function glyphAtlasOf(runs: readonly PositionedRun[]): GlyphAtlas | undefined {
  const inked = new Map(runs.filter(hasInk).map((run) => [run.text, run]));
  for (const texelsPerEm of resolutions) {
    const atlas = pack(Array.from(inked.values()), texelsPerEm);
    if (atlas.width <= maxEdge && atlas.height <= maxEdge && atlas.width * atlas.height <= maxTexels) return atlas;
  }
  return undefined;
}

export function hasInk({ metrics: { ink } }: PositionedRun): boolean {
  return ink.left + ink.right > 0 && ink.up + ink.down > 0;
}

/** Packs runs into rows of about the width of a square atlas. */
function pack(runs: readonly PositionedRun[], texelsPerEm: number): GlyphAtlas {
  const sizes = runs.map(({ text, metrics: { ink } }) => ({
    text,
    penX: Math.ceil(ink.left * texelsPerEm) + fieldSpread,
    penY: Math.ceil(ink.up * texelsPerEm) + fieldSpread,
    width: Math.ceil(ink.left * texelsPerEm) + Math.ceil(ink.right * texelsPerEm) + 2 * fieldSpread,
    height: Math.ceil(ink.up * texelsPerEm) + Math.ceil(ink.down * texelsPerEm) + 2 * fieldSpread,
  }));
  const area = sizes.reduce((sum, { width, height }) => sum + width * height, 0);
  const maxWidth = Math.max(...sizes.map((size) => size.width), Math.min(Math.ceil(Math.sqrt(area)), maxEdge), 1);
  const cells = new Map<string, GlyphCell>();
  let [left, top, rowHeight, width] = [0, 0, 0, 1];
  for (const { text, penX, penY, ...size } of sizes) {
    if (left + size.width > maxWidth) [left, top, rowHeight] = [0, top + rowHeight, 0];
    cells.set(text, { left, top, ...size, penX: left + penX, penY: top + penY });
    left += size.width;
    width = Math.max(width, left);
    rowHeight = Math.max(rowHeight, size.height);
  }
  return { width, height: Math.max(top + rowHeight, 1), texelsPerEm, cells };
}

/** The data: URL that `drawGlyphAtlas` reads. `edition` counts loads of the font, and changes only the URL. */
export function glyphAtlasUrl(
  { width, height, texelsPerEm, cells }: GlyphAtlas,
  { family, isBold, isItalic }: Font,
  edition: number,
): string {
  const font = `${isItalic ? "italic " : ""}${isBold ? "bold " : ""}${texelsPerEm}px ${family}`;
  const runs = Array.from(cells, ([text, { penX, penY }]) => ({ text, x: penX, y: penY }));
  return dataUrl(
    "application/json",
    new TextEncoder().encode(JSON.stringify({ width, height, spread: fieldSpread, font, edition, runs })),
  );
}
