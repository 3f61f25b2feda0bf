// Measures and draws glyphs on a canvas, with fonts of the system and of the page.

import { distanceField } from "./distanceField.ts";

/** The largest edge of an atlas that glyphAtlas.ts packs. */
const maxEdge = 2048;

/**
 * The content of a glyph atlas URL: runs with their pen positions from the upper left, and a CSS font with its size.
 */
interface AtlasDescription {
  readonly width: number;
  readonly height: number;
  /** The range of the distance field, in texels to each side of an edge. */
  readonly spread: number;
  readonly font: string;
  readonly runs: readonly { readonly text: string; readonly x: number; readonly y: number }[];
}

/** The description of an atlas is malformed, or the browser has no canvas to draw it on. */
export class GlyphAtlasError extends Error {
  readonly kind: "malformed" | "unsupported";

  constructor(kind: GlyphAtlasError["kind"], message: string) {
    super(message);
    this.kind = kind;
  }
}

let measuringContext: OffscreenCanvasRenderingContext2D | undefined;

/** The font size of measurements, in pixels: browsers round font metrics to whole pixels, which is 1/1000 em here. */
const measuringSize = 512;

/** The metrics of a run in em (RunMetrics of textLayout.ts). */
export function measureRun(
  { family, isBold, isItalic }: { family: string; isBold: boolean; isItalic: boolean },
  text: string,
): {
  advance: number;
  ink: { left: number; right: number; up: number; down: number };
  ascent: number;
  descent: number;
} {
  measuringContext ??= contextOf(1, 1);
  measuringContext.font = `${isItalic ? "italic " : ""}${isBold ? "bold " : ""}${measuringSize}px ${family}`;
  const metrics = measuringContext.measureText(text);
  const {
    actualBoundingBoxLeft: left,
    actualBoundingBoxRight: right,
    actualBoundingBoxAscent: up,
    actualBoundingBoxDescent: down,
  } = metrics;
  const inEm = (pixels: number) => pixels / measuringSize;
  return {
    advance: inEm(metrics.width),
    ink: { left: inEm(left), right: inEm(right), up: inEm(up), down: inEm(down) },
    ascent: inEm(metrics.fontBoundingBoxAscent),
    descent: inEm(metrics.fontBoundingBoxDescent),
  };
}

/**
 * Draws a bitmap with the glyphs' distance field as alpha, bottom row first. Its colours mean nothing: WebKit
 * multiplies those of image data by alpha whatever is asked for. Rejects with GlyphAtlasError.
 */
export async function drawGlyphAtlas(bytes: Uint8Array<ArrayBuffer>): Promise<ImageBitmap> {
  const { width, height, spread, font, runs } = parseDescription(bytes);
  const context = contextOf(width, height);
  context.font = font;
  context.fillStyle = "white";
  for (const { text, x, y } of runs) context.fillText(text, x, y);
  const image = context.getImageData(0, 0, width, height);
  const field = distanceField(
    Uint8Array.from({ length: width * height }, (_, texel) => image.data[4 * texel + 3] ?? 0),
    width,
    height,
    spread,
  );
  field.forEach((distance, texel) => {
    image.data[4 * texel + 3] = distance;
  });
  return createImageBitmap(image, { imageOrientation: "flipY", colorSpaceConversion: "none" });
}

function contextOf(width: number, height: number): OffscreenCanvasRenderingContext2D {
  const context = new OffscreenCanvas(width, height).getContext("2d", { willReadFrequently: true });
  if (context === null) throw new GlyphAtlasError("unsupported", "is a text, and this browser has no canvas for it");
  context.textRendering = "geometricPrecision"; // exact outlines, not hinted to whole pixels
  return context;
}

function parseDescription(bytes: Uint8Array): AtlasDescription {
  const description: unknown = JSON.parse(new TextDecoder().decode(bytes));
  if (!isDescription(description)) throw new GlyphAtlasError("malformed", "is no glyph atlas");
  return description;
}

function isDescription(value: unknown): value is AtlasDescription {
  if (typeof value !== "object" || value === null) return false;
  const { width, height, spread, font, runs } = value as Partial<Record<keyof AtlasDescription, unknown>>;
  const isEdge = (edge: unknown) => Number.isInteger(edge) && Number(edge) > 0 && Number(edge) <= maxEdge;
  return isEdge(width) && isEdge(height) && isEdge(spread) && typeof font === "string" && Array.isArray(runs);
}
