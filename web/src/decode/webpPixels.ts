// Decodes a lossless WebP to its stored bytes in JavaScript (RFC 9649). Browsers return them through WebGL, which not
// all have in workers, and WebKit loses the colours of transparent pixels.

import type { Pixels } from "./pngPixels.ts";
import { BitReader } from "./vp8l/bits.ts";
import { readCodedImage } from "./vp8l/entropyCoded.ts";
import { readTransforms } from "./vp8l/transforms.ts";
import { bitstreamOf, checkWebp } from "./webp.ts";

/** Decodes a whole image. Throws DecodeError. Safe for untrusted bytes: edges are limited to `maxEdge`. */
export function decodeWebpPixels(webp: Uint8Array<ArrayBuffer>, maxEdge?: number): Pixels {
  const { width, height, channels } = checkWebp(webp, maxEdge);
  const { bitstream, hasAlpha } = bitstreamOf(webp);
  const bits = new BitReader(bitstream);
  const { transforms, storedWidth } = readTransforms(bits, width, height);
  const stored = readCodedImage(bits, storedWidth, height, true);
  const { pixels } = transforms.reduce((image, transform) => transform(image), stored);
  const data = new Uint8Array(4 * width * height);
  pixels.forEach((pixel, at) => {
    data[4 * at] = pixel >>> 16;
    data[4 * at + 1] = pixel >>> 8;
    data[4 * at + 2] = pixel;
    data[4 * at + 3] = hasAlpha ? pixel >>> 24 : 255;
  });
  return { width, height, channels, data };
}
