// The bytes of an image of vertex data, for workers that decode on the CPU.

import { decodePixels as decodePngPixels } from "./pngPixels.ts";
import type { Pixels } from "./pngPixels.ts";
import { isWebp } from "./webpContainer.ts";
import { decodeWebpPixels } from "./webpPixels.ts";

export type { Pixels } from "./pngPixels.ts";

/**
 * Decodes a whole PNG or lossless WebP to its stored bytes by decoders of our own. Rejects with DecodeError. Safe for
 * untrusted bytes.
 */
export async function decodePixels(bytes: Uint8Array<ArrayBuffer>): Promise<Pixels> {
  return isWebp(bytes) ? decodeWebpPixels(bytes) : decodePngPixels(bytes);
}
