// The jobs of SIG compact: decode a whole file of patches, or of base meshes.

import { DecodeError } from "../decodeError.ts";
import type { BaseBuffers } from "./baseBuffers.ts";
import { Base } from "./baseBuffers.ts";
import { decodeFile } from "./decodeFile.ts";
import { payloadOf } from "./payload.ts";
import type { LevelGroup } from "./levelGroup.ts";
import { groupOf } from "./levelGroup.ts";
import type { PatchBuffers } from "./patchBuffers.ts";

/** Decodes all patches of a file. Rejects with DecodeError. Safe for untrusted bytes. */
export async function compactPatches(png: Uint8Array<ArrayBuffer>): Promise<PatchBuffers[]> {
  return decodeFile(await payloadOf(png)).map(({ buffers, segments }) => {
    if (segments) throw new DecodeError("malformed", "holds a base where a patch should be");
    return buffers;
  });
}

/** Decodes the segments of all base meshes of a file. Rejects with DecodeError. Safe for untrusted bytes. */
export async function compactBases(png: Uint8Array<ArrayBuffer>): Promise<BaseBuffers[]> {
  return decodeFile(await payloadOf(png)).map((patch) => new Base(patch).segments);
}

/** Decodes a file of a group of a level of detail. Rejects with DecodeError. Safe for untrusted bytes. */
export async function compactGroup(png: Uint8Array<ArrayBuffer>): Promise<LevelGroup> {
  return groupOf(decodeFile(await payloadOf(png)));
}
