// The jobs of SIG compact: decode a whole file of patches, or of base meshes.

import { DecodeError } from "../decodeError.ts";
import { decodePixels } from "../pngPixels.ts";
import type { BaseBuffers } from "./baseBuffers.ts";
import { Base } from "./baseBuffers.ts";
import { decodePatches } from "./patch.ts";
import type { PatchBuffers } from "./patchBuffers.ts";
import { buffersOf } from "./patchBuffers.ts";

/** Decodes all patches of a file. Rejects with DecodeError. Safe for untrusted bytes. */
export async function compactPatches(png: Uint8Array<ArrayBuffer>): Promise<PatchBuffers[]> {
  return decodePatches(await payloadOf(png), (patch) => {
    if (patch.segments) throw new DecodeError("malformed", "holds a base where a patch should be");
    return buffersOf(patch);
  });
}

/** Decodes the segments of all base meshes of a file. Rejects with DecodeError. Safe for untrusted bytes. */
export async function compactBases(png: Uint8Array<ArrayBuffer>): Promise<BaseBuffers[]> {
  return (await decodeBases(png)).map((base) => base.segments);
}

/** Decodes all base meshes of a file, whole. Rejects with DecodeError. Safe for untrusted bytes. */
export async function decodeBases(png: Uint8Array<ArrayBuffer>): Promise<Base[]> {
  return decodePatches(await payloadOf(png), (patch) => new Base(patch));
}

/** The pixels of a gray PNG. Rejects with DecodeError. Safe for untrusted bytes. */
export async function payloadOf(png: Uint8Array<ArrayBuffer>): Promise<Uint8Array<ArrayBuffer>> {
  const { channels, data } = await decodePixels(png);
  if (channels !== 1) throw new DecodeError("malformed", "is a PNG of colours, not of gray");
  return data;
}
