// Decodes images with alpha to texels of a texture, in JavaScript, for browsers whose ImageBitmap loses the colours of
// transparent texels.

import { DecodeError } from "./decodeError.ts";
import { pngTexels, type Texels, type TexelsJob } from "./pngTexels.ts";
import { isWebp } from "./webpContainer.ts";
import { decodeWebpPixels } from "./webpPixels.ts";

/**
 * Undefined for formats other than PNG and lossless WebP, where decoding needs a browser, and for damaged files. Safe
 * for untrusted bytes.
 */
export async function imageTexels(job: TexelsJob): Promise<Texels | undefined> {
  return isWebp(job.bytes) ? webpTexels(job) : pngTexels(job);
}

/** A WebP of the simple format has no colour profile. */
function webpTexels({ bytes, maxEdge }: TexelsJob): Texels | undefined {
  try {
    const { width, height, data } = decodeWebpPixels(bytes, maxEdge);
    const length = 4 * width;
    const texels = new Uint8Array(data.length);
    for (let row = 0; row < height; ++row)
      texels.set(data.subarray(row * length, (row + 1) * length), (height - 1 - row) * length);
    return { width, height, data: texels };
  } catch (error) {
    if (error instanceof DecodeError) return undefined;
    throw error;
  }
}
