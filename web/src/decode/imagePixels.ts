// The bytes of an image of vertex data, for workers that decode on the CPU.

import { readBitmap } from "./bitmapPixels.ts";
import { decodeImage, decodeWithBrowser } from "./image.ts";
import { decodePixels as decodePngPixels } from "./pngPixels.ts";
import type { Pixels } from "./pngPixels.ts";
import { isWebp } from "./webp.ts";

export type { Pixels } from "./pngPixels.ts";

/**
 * Decodes a whole image to its stored bytes: a PNG by our own decoder, a WebP by the browser's, whose pixels are read
 * back exactly. Rejects with DecodeError. Safe for untrusted bytes.
 */
export async function decodePixels(bytes: Uint8Array<ArrayBuffer>): Promise<Pixels> {
  if (!isWebp(bytes)) return decodePngPixels(bytes);
  const { image, channels } = await decodeImage(bytes, decodeWithBrowser);
  try {
    return { width: image.width, height: image.height, channels, data: readBitmap(image) };
  } finally {
    image.close();
  }
}
