// A decoded group of triangles of a level of detail (docs/formats/levels.md): a patch, or a base whose segments are the
// coarse forms of the group's children.

import { DecodeError } from "../decodeError.ts";
import { makeIndex } from "../indexArray.ts";
import { trianglesBySegment } from "./baseBuffers.ts";
import type { DecodedPatch } from "./decodedFile.ts";
import type { PatchBuffers } from "./patchBuffers.ts";

export interface LevelGroup {
  /** The triangles are in the order of the segments. */
  readonly buffers: PatchBuffers;
  /** The first triangle of each segment, and at the end the number of triangles. A patch counts as one segment. */
  readonly segmentStarts: Int32Array;
  /** Whether the file holds a base. */
  readonly hasSegments: boolean;
}

/** Throws DecodeError for points and lines. */
export function groupOf({ buffers, segments }: DecodedPatch): LevelGroup {
  const { index, topology, vertexCount } = buffers;
  if (topology !== "triangles" || index === undefined) throw new DecodeError("malformed", `holds ${topology}`);
  if (segments === undefined) return { buffers, segmentStarts: Int32Array.of(0, index.length / 3), hasSegments: false };
  const { firsts, triangles } = trianglesBySegment(segments.segment, segments.segmentCount);
  const sorted = makeIndex(vertexCount, index.length);
  for (const [to, from] of triangles.entries())
    for (let corner = 0; corner < 3; ++corner) sorted[3 * to + corner] = index[3 * from + corner]!;
  return { buffers: { ...buffers, index: sorted }, segmentStarts: firsts, hasSegments: true };
}
