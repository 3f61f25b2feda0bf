// What a file of compact decodes to, by either decoder: the arrays of each patch, and the segments of a base mesh.

import type { PatchBuffers } from "./patchBuffers.ts";

export interface SegmentsOfTriangles {
  /** The segment of each triangle, in the order of the index. */
  readonly segment: Int32Array;
  readonly segmentCount: number;
}

export interface DecodedPatch {
  /** The triangles of a base mesh are in the order of `segments`. */
  readonly buffers: PatchBuffers;
  /** Base meshes only. */
  readonly segments: SegmentsOfTriangles | undefined;
}

/** Decodes all patches or base meshes of a payload. */
export type DecodeFile = (payload: Uint8Array) => DecodedPatch[];
