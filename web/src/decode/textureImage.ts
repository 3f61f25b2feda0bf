// Decodes texture images: any format that the browser decodes, with its own colour management.

import { DecodeError } from "./decodeError.ts";
import type { RunJob } from "./jobs.ts";
import type { Texels } from "./pngTexels.ts";

/** Texels in memory, where the browser's ImageBitmap would lose colours. */
export interface TexelArray extends Texels {
  close(): void;
}

export interface DecodedTextureImage {
  readonly bitmap: ImageBitmap | TexelArray;
  readonly hasAlpha: boolean;
}

/** The file of a texture image. */
export interface TextureFile {
  readonly bytes: Uint8Array<ArrayBuffer>;
  /** Where it has been requested, or a data: URL. */
  readonly url: string;
}

/** What the texels of a texture image mean. */
export interface TextureImageKind {
  /** Texels are data, not colours, so that no colour conversion applies. */
  readonly isData: boolean;
  /** The file describes glyphs; the image is drawn as their distance field. */
  readonly isDistanceField?: true;
}

let drawAtlas: ((bytes: Uint8Array<ArrayBuffer>) => Promise<ImageBitmap>) | undefined;

/** Adds glyphAtlasImage.ts; call before the first text is displayed. */
export function addGlyphAtlases(draw: typeof drawAtlas): void {
  drawAtlas = draw;
}

export interface TextureDecoding extends TextureImageKind {
  /** Larger images are scaled down. */
  readonly maxEdge: number;
  readonly runJob: RunJob;
  readonly signal: AbortSignal;
}

/** Decodes an image with alpha where ImageBitmaps lose colours; undefined where they do not, or it cannot. */
export type DecodeAlphaImage = (file: TextureFile, decoding: TextureDecoding) => Promise<TexelArray | undefined>;

/** Loads alphaImage.ts, which some browsers need. */
let alphaImages: { load(): Promise<{ readonly decodeAlphaImage: DecodeAlphaImage }> } | undefined;

export function setAlphaImages(part: typeof alphaImages): void {
  alphaImages = part;
}

/** Decodes an image. Rejects with DecodeError. */
export async function decodeTextureImage(file: TextureFile, decoding: TextureDecoding): Promise<DecodedTextureImage> {
  const { bytes } = file;
  const { isData, isDistanceField, maxEdge } = decoding;
  if (isDistanceField === true) {
    if (drawAtlas === undefined) throw new DecodeError("unsupported", "describes glyphs, but there is no text");
    return { bitmap: await drawAtlas(bytes), hasAlpha: true };
  }
  const hasAlpha = mayHaveAlpha(bytes);
  // Browsers with an ImageDecoder are known to keep colours; what others do is tested in the module.
  if (hasAlpha && !("ImageDecoder" in globalThis)) {
    const texels = await (await alphaImages?.load())?.decodeAlphaImage(file, decoding);
    if (texels) return { bitmap: texels, hasAlpha };
  }
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
  if (edge <= maxEdge) return { bitmap, hasAlpha };
  const resizeWidth = Math.max(1, Math.floor((bitmap.width * maxEdge) / edge));
  const smaller = await createImageBitmap(bitmap, { resizeWidth, resizeQuality: "high", premultiplyAlpha: "none" });
  bitmap.close();
  return { bitmap: smaller, hasAlpha };
}

/** The offset of the colour type in a PNG, and the colour types with alpha. */
const [pngColorTypeOffset, grayWithAlpha, rgba] = [25, 4, 6];
/** By the first chunk of a WebP file, the byte with the bit for alpha; lossy files of one chunk have none. */
const webpFlagOffsets: Readonly<Record<string, number>> = { VP8X: 20, VP8L: 24 };
const webpAlphaFlag = 0x10;

/**
 * Whether the image may have transparent texels, by its format: the header or a transparent colour of PNG, the flags of
 * WebP; never in JPEG, and always in other formats.
 */
export function mayHaveAlpha(bytes: Uint8Array): boolean {
  const text = (from: number, length: number) => String.fromCharCode(...bytes.subarray(from, from + length));
  if (text(1, 3) === "PNG") {
    const type = bytes[pngColorTypeOffset];
    return type === grayWithAlpha || type === rgba || text(33, 1024).includes("tRNS");
  }
  if (bytes[0] === 0xff && bytes[1] === 0xd8) return false;
  if (text(8, 4) === "WEBP") {
    const offset = webpFlagOffsets[text(12, 4)];
    return offset !== undefined && ((bytes[offset] ?? 0) & webpAlphaFlag) !== 0;
  }
  return true;
}
