// The letters of a text in one picture, which decode/letters.ts draws: runs of text in
// rows, each with room around it for the field of distances from its edges.

import { dataUrl } from "../document/dataUrl.ts";
import type { Font, PositionedRun } from "./textLayout.ts";

/** Texels over which the field falls from an edge to nothing. */
export const fieldSpread = 8;

/** Texels of an em, from the best on: what fits is taken. With less than the last letters are not to be read. */
const resolutions = [96, 64, 48, 32, 24, 16, 12];
/** Every GPU has textures of this edge. */
const maxEdge = 2048;
/** Of which the field is made within some 50 ms. */
const maxTexels = 2 ** 18;

/** In texels, from the upper left corner of the sheet; the pen is where the run begins on its baseline. */
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

/** A cell for each text that has ink, once however often it stands there; undefined where they are too many. */
export function glyphAtlasOf(runs: readonly PositionedRun[]): GlyphAtlas | undefined {
  const inked = new Map(runs.filter(hasInk).map((run) => [run.text, run]));
  for (const texelsPerEm of resolutions) {
    const sheet = packed(Array.from(inked.values()), texelsPerEm);
    if (sheet.width <= maxEdge && sheet.height <= maxEdge && sheet.width * sheet.height <= maxTexels) return sheet;
  }
  return undefined;
}

export function hasInk({ metrics: { ink } }: PositionedRun): boolean {
  return ink.left + ink.right > 0 && ink.up + ink.down > 0;
}

/** One row after the other, of about the width that makes a square. */
function packed(runs: readonly PositionedRun[], texelsPerEm: number): GlyphAtlas {
  const sizes = runs.map(({ text, metrics: { ink } }) => ({
    text,
    penX: Math.ceil(ink.left * texelsPerEm) + fieldSpread,
    penY: Math.ceil(ink.up * texelsPerEm) + fieldSpread,
    width: Math.ceil(ink.left * texelsPerEm) + Math.ceil(ink.right * texelsPerEm) + 2 * fieldSpread,
    height: Math.ceil(ink.up * texelsPerEm) + Math.ceil(ink.down * texelsPerEm) + 2 * fieldSpread,
  }));
  const area = sizes.reduce((sum, { width, height }) => sum + width * height, 0);
  const most = Math.max(...sizes.map((size) => size.width), Math.min(Math.ceil(Math.sqrt(area)), maxEdge), 1);
  const cells = new Map<string, GlyphCell>();
  let [left, top, rowHeight, width] = [0, 0, 0, 1];
  for (const { text, penX, penY, ...size } of sizes) {
    if (left + size.width > most) [left, top, rowHeight] = [0, top + rowHeight, 0];
    cells.set(text, { left, top, ...size, penX: left + penX, penY: top + penY });
    left += size.width;
    width = Math.max(width, left);
    rowHeight = Math.max(rowHeight, size.height);
  }
  return { width, height: Math.max(top + rowHeight, 1), texelsPerEm, cells };
}

/** What decode/letters.ts reads; the edition of the font only makes it another url. */
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
