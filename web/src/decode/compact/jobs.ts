// What workers do for SIG compact: a file once, then each of its patches, or a base.

import { DecodeError } from "../decodeError.ts";
import { decodePixels } from "../pngPixels.ts";
import { baseBuffersOf } from "./baseBuffers.ts";
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
  return new Promise((resolve) => {
    const patch = decodePatch(bytes, 0);
    if (patch.parts) throw new DecodeError("malformed", "holds a base where a patch should be");
    resolve(buffersOf(patch));
  });
}

/** The parts of the base that these bytes begin with. Rejects with DecodeError. Safe for untrusted bytes. */
export function compactBase(bytes: Uint8Array<ArrayBuffer>): Promise<(PatchBuffers | undefined)[]> {
  return new Promise((resolve) => { resolve(baseBuffersOf(decodePatch(bytes, 0))); });
}
