// Checks a PNG of vertex data before it is decoded (PNG specification, W3C 2003, sections 5 and 11). A browser displays
// a 16-bit, transparent or incomplete image as best it can; an image of vertex data would silently become a wrong
// shape.

import { DecodeError } from "./decodeError.ts";
import { foreignFormatOf } from "./foreignFormat.ts";

/** What the file of an image states. */
export interface ImageHeader {
  readonly width: number;
  readonly height: number;
  /** Components of a texel: 1 for gray, 3 for RGB and palettes, 4 for RGBA. */
  readonly channels: 1 | 3 | 4;
}

/** Maximum width and height that readers of the format accept (docs/formats/sig-classic.md). */
export const maxImageEdge = 4096;

const signature = [0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a];
const headerLength = 13;
const chunkOverhead = 12; // length, type, CRC
/** By PNG colour type; 3 is a palette. */
const channelsOfColorType: Readonly<Record<number, ImageHeader["channels"]>> = { 0: 1, 2: 3, 3: 3, 6: 4 };

/**
 * Checks that the bytes are one whole PNG of 8-bit gray, RGB, RGBA or an opaque palette, not interlaced, with no edge
 * longer than `maxEdge`, and returns its size. Safe for untrusted bytes. Throws DecodeError.
 */
export function checkPng(bytes: Uint8Array, maxEdge = maxImageEdge): ImageHeader {
  const types = checkChunks(bytes);
  if (types.includes("tRNS")) throw new DecodeError("unsupported", "has colours that are see-through");
  return readHeader(bytes, maxEdge);
}

/**
 * Checks that the bytes are one whole PNG with its chunks in order, and returns their types. Safe for untrusted bytes.
 * Throws DecodeError.
 */
export function checkChunks(bytes: Uint8Array): readonly string[] {
  if (!signature.every((byte, index) => bytes[index] === byte)) {
    const other = foreignFormatOf(bytes);
    if (other !== undefined)
      throw new DecodeError(
        "unsupported",
        `is ${other}; vertex data must be PNG or lossless WebP, which keep every byte`,
      );
    throw new DecodeError(bytes.length < signature.length ? "truncated" : "malformed", "is no PNG image");
  }
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const types = chunkTypes(view);
  if (types[0] !== "IHDR" || view.getUint32(signature.length) !== headerLength) {
    throw new DecodeError("malformed", "does not begin with a PNG header");
  }
  checkOrder(types);
  return types;
}

/**
 * Throws unless there is one header, at most one palette, the chunks of image data are consecutive, and every other
 * chunk is ancillary.
 */
function checkOrder(types: readonly string[]): void {
  const isCritical = (type: string) => (type.charCodeAt(0) & 32) === 0; // its first letter is upper case
  if (types.slice(1).some((type) => isCritical(type) && !["PLTE", "IDAT", "IEND"].includes(type))) {
    throw new DecodeError("malformed", "has a chunk that no reader knows");
  }
  const runs = types.filter((type, index) => type === "IDAT" && types[index - 1] !== "IDAT").length;
  if (runs === 0) throw new DecodeError("malformed", "holds no image data");
  if (runs > 1 || types.indexOf("PLTE") !== types.lastIndexOf("PLTE"))
    throw new DecodeError("malformed", "has its chunks out of order");
}

function readHeader(bytes: Uint8Array, maxEdge: number): ImageHeader {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const offset = signature.length + 8;
  const width = view.getUint32(offset);
  const height = view.getUint32(offset + 4);
  const [bitDepth, colorType, compression, filter, interlace] = [8, 9, 10, 11, 12].map((index) =>
    view.getUint8(offset + index),
  );
  if (width < 1 || height < 1 || width > maxEdge || height > maxEdge) {
    throw new DecodeError("limit", `is ${width} x ${height} texels large; 1 to ${maxEdge} are allowed`);
  }
  const channels = channelsOfColorType[colorType ?? NaN];
  if (bitDepth !== 8 || channels === undefined) {
    throw new DecodeError(
      "unsupported",
      `has ${String(bitDepth)} bits a channel and PNG colour type ${String(colorType)}, not 8-bit gray, RGB, RGBA or palette`,
    );
  }
  if (interlace !== 0) throw new DecodeError("unsupported", "is interlaced");
  if (compression !== 0 || filter !== 0)
    throw new DecodeError("malformed", "has an unknown compression or filter method");
  return { width, height, channels };
}

/** The types of the chunks in order. Throws unless IEND is the last chunk and ends exactly at the end of the bytes. */
function chunkTypes(view: DataView): string[] {
  const types: string[] = [];
  let offset = signature.length;
  while (types.at(-1) !== "IEND") {
    if (view.byteLength - offset < chunkOverhead) throw new DecodeError("truncated", "ends before its last chunk");
    const length = view.getUint32(offset);
    if (length > view.byteLength - offset - chunkOverhead) throw new DecodeError("truncated", "ends inside a chunk");
    types.push(String.fromCharCode(...[4, 5, 6, 7].map((index) => view.getUint8(offset + index))));
    offset += length + chunkOverhead;
  }
  if (offset !== view.byteLength) throw new DecodeError("malformed", "goes on after its end");
  return types;
}
