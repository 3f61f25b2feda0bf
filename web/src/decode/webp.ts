// Checks a WebP image of vertex data before a browser decodes it (RFC 9649). Lossless files alone keep every byte, and
// only those of the simple format: the extended format may add a colour profile or an animation.

import { DecodeError } from "./decodeError.ts";
import type { ImageHeader } from "./png.ts";
import { maxImageEdge } from "./png.ts";
import { isWebp, textAt } from "./webpContainer.ts";

/** Byte offsets in a file of one VP8L chunk: "RIFF", size, "WEBP", "VP8L", size, signature, header of 32 bits. */
const riffSizeOffset = 4;
const formatOffset = 8;
const chunkOffset = 12;
const chunkSizeOffset = 16;
const bitstreamOffset = 20;
const headerEnd = bitstreamOffset + 5;
const losslessSignature = 0x2f;

/**
 * Checks that the bytes are one whole lossless WebP image, with no edge longer than `maxEdge`, and returns its size. It
 * has four channels: where the file has no alpha, it is 255. Safe for untrusted bytes. Throws DecodeError.
 */
export function checkWebp(bytes: Uint8Array, maxEdge = maxImageEdge): ImageHeader {
  if (!isWebp(bytes)) throw new DecodeError("malformed", "is no WebP image");
  if (bytes.length < headerEnd) throw new DecodeError("truncated", "ends inside its header");
  const chunk = textAt(bytes, chunkOffset);
  if (chunk === "VP8 ")
    throw new DecodeError("unsupported", "is a lossy WebP image; vertex data must be PNG or lossless WebP");
  if (chunk !== "VP8L")
    throw new DecodeError("unsupported", "is a WebP image of the extended format; vertex data has the simple one");
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const chunkSize = view.getUint32(chunkSizeOffset, true);
  const fileSize = bitstreamOffset + chunkSize + (chunkSize % 2); // chunks are padded to even sizes
  if (fileSize > bytes.length) throw new DecodeError("truncated", "ends inside its image");
  if (fileSize < bytes.length || view.getUint32(riffSizeOffset, true) !== fileSize - formatOffset)
    throw new DecodeError("malformed", "has a size that its header does not state");
  // 14 bits each of width - 1 and height - 1, a bit that says whether alpha is used, 3 bits of version.
  const header = view.getUint32(bitstreamOffset + 1, true);
  if (view.getUint8(bitstreamOffset) !== losslessSignature || header >>> 29 !== 0)
    throw new DecodeError("malformed", "is no lossless WebP image that readers know");
  const width = 1 + (header & 0x3fff);
  const height = 1 + ((header >>> 14) & 0x3fff);
  if (width > maxEdge || height > maxEdge)
    throw new DecodeError("limit", `is ${width} x ${height} texels large; 1 to ${maxEdge} are allowed`);
  return { width, height, channels: 4 };
}

/** The transforms and pixels of a file that `checkWebp` has accepted, and whether it has alpha. */
export function bitstreamOf(webp: Uint8Array): { readonly bitstream: Uint8Array; readonly hasAlpha: boolean } {
  return { bitstream: webp.subarray(headerEnd), hasAlpha: ((webp[headerEnd - 1] ?? 0) & 0x10) !== 0 };
}
