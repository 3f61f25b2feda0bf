// What workers do for SIG compact: a file once, then each of its patches.

import { DecodeError } from "../decodeError.ts";
import { decodePixels } from "../pngPixels.ts";
import { decodePatch } from "./patch.ts";
import type { PatchBuffers } from "./patchBuffers.ts";
import { buffersOf } from "./patchBuffers.ts";

/** The bytes that patches lie in: the pixels of a gray PNG. Rejects with DecodeError. Safe for untrusted bytes. */
export async function compactPayload(png: Uint8Array<ArrayBuffer>): Promise<Uint8Array<ArrayBuffer>> {
  const { channels, data } = await decodePixels(png);
  if (channels !== 1) throw new DecodeError("malformed", "is a PNG of colours, not of gray");
  return data;
}

/** The patch that these bytes begin with. Rejects with DecodeError. Safe for untrusted bytes. */
export function compactPatch(bytes: Uint8Array<ArrayBuffer>): Promise<PatchBuffers> {
  return new Promise((resolve) => { resolve(buffersOf(decodePatch(bytes, 0))); });
}
