// Pictures that are looked at: whatever the browser can decode, in its own way
// with colours.

import { DecodeError } from "./decodeError.ts";
import { drawGlyphAtlas, GlyphAtlasError } from "../text/glyphRendering.ts";

export interface DecodedPicture {
  readonly bitmap: ImageBitmap;
  readonly hasAlpha: boolean;
}

/** What a picture's numbers mean. */
export interface PictureKind {
  /** No colours: no number is converted. */
  readonly isData: boolean;
  /** The file tells of letters, whose field of distances is made. */
  readonly isDistanceField?: true;
}

/** Larger ones are made smaller. Rejects with DecodeError. */
export async function decodePicture(
  bytes: Uint8Array<ArrayBuffer>,
  maxEdge: number,
  { isData, isDistanceField }: PictureKind,
): Promise<DecodedPicture> {
  if (isDistanceField === true) return { bitmap: await glyphsIn(bytes), hasAlpha: true };
  const options: ImageBitmapOptions = {
    premultiplyAlpha: "none",
    imageOrientation: "flipY",
    colorSpaceConversion: isData ? "none" : "default",
  };
  let bitmap: ImageBitmap;
  try {
    bitmap = await createImageBitmap(new Blob([bytes]), options);
  } catch {
    throw new DecodeError("unsupported", "is no picture that this browser can show");
  }
  const edge = Math.max(bitmap.width, bitmap.height);
  if (edge <= maxEdge) return { bitmap, hasAlpha: mayHaveAlpha(bytes) };
  const resizeWidth = Math.max(1, Math.floor((bitmap.width * maxEdge) / edge));
  const smaller = await createImageBitmap(bitmap, { resizeWidth, resizeQuality: "high", premultiplyAlpha: "none" });
  bitmap.close();
  return { bitmap: smaller, hasAlpha: mayHaveAlpha(bytes) };
}

async function glyphsIn(bytes: Uint8Array<ArrayBuffer>): Promise<ImageBitmap> {
  try {
    return await drawGlyphAtlas(bytes);
  } catch (error) {
    if (error instanceof GlyphAtlasError) throw new DecodeError(error.kind, error.message);
    throw error;
  }
}

const [pngColorType, grayWithAlpha, rgba] = [25, 4, 6];

/**
 * Told by the format: PNG's header (or a colour that is see-through), WebP's flags; no JPEG has any. Anything else may.
 */
export function mayHaveAlpha(bytes: Uint8Array): boolean {
  const text = (from: number, length: number) => String.fromCharCode(...bytes.subarray(from, from + length));
  if (text(1, 3) === "PNG") {
    const type = bytes[pngColorType];
    return type === grayWithAlpha || type === rgba || text(33, 1024).includes("tRNS");
  }
  if (bytes[0] === 0xff && bytes[1] === 0xd8) return false;
  if (text(8, 4) === "WEBP") return text(12, 4) === "VP8X" ? ((bytes[20] ?? 0) & 0x10) !== 0 : text(12, 4) === "VP8L";
  return true;
}
