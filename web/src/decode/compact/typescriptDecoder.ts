// The decoder of compact in TypeScript. It decodes whatever WebAssembly does not (decodeFile.ts).

import type { DecodedPatch, DecodeFile } from "./decodedFile.ts";
import type { CompactPatch } from "./patch.ts";
import { decodePatches } from "./patch.ts";
import { buffersOf, unorderedBuffersOf } from "./patchBuffers.ts";

/** Safe for untrusted bytes. Throws DecodeError. */
export const decodeWithTypeScript: DecodeFile = (payload) => decodePatches(payload, decodedOf);

/** The arrays of a decoded patch or base mesh. */
export function decodedOf(patch: CompactPatch): DecodedPatch {
  const { segments, header } = patch;
  if (!segments) return { buffers: buffersOf(patch), segments: undefined };
  return {
    buffers: unorderedBuffersOf(patch),
    segments: { segment: segments.segment, segmentCount: header.segmentCount },
  };
}
