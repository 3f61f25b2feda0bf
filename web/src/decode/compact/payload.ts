// The payload of a file of compact: the pixels of a gray PNG.

import { DecodeError } from "../decodeError.ts";
import { decodePixels } from "../pngPixels.ts";

/** The pixels of a gray PNG. Rejects with DecodeError. Safe for untrusted bytes. */
export async function payloadOf(png: Uint8Array<ArrayBuffer>): Promise<Uint8Array<ArrayBuffer>> {
  const { channels, data } = await decodePixels(png);
  if (channels !== 1) throw new DecodeError("malformed", "is a PNG of colours, not of gray");
  return data;
}
