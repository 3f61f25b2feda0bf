// Decodes the segment of a base mesh that each triangle belongs to, that is, which patch it stands in for:
// docs/formats/compact.md, "Base".

import { DecodeError } from "../decodeError.ts";
import type { Connectivity } from "./connectivity.ts";
import type { RangeDecoder } from "./rangeDecoder.ts";
import { numberModelCount } from "./rangeDecoder.ts";
import type { PatchHeader } from "./sizes.ts";

const sameModels = 0;
const otherModels = sameModels + 4;
const segmentModels = otherModels + 4;
export const segmentModelCount = segmentModels + numberModelCount;

export interface Segments {
  /** Per triangle: its segment. */
  readonly segment: Int32Array;
  /** Per vertex: 1 where triangles of several segments use it. */
  readonly isShared: Uint8Array;
}

/** Safe for untrusted bytes. Throws DecodeError. */
export function decodeSegments(decoder: RangeDecoder, header: PatchHeader, { vertex, across }: Connectivity): Segments {
  const segment = new Int32Array(header.elementCount);
  const isShared = new Uint8Array(header.vertexCount);
  const latest = new Int32Array(header.vertexCount).fill(-1);
  for (let t = 0; t < segment.length; ++t) {
    const c = 3 * t;
    const o = across[t]!;
    const guess = o >= 0 ? segment[Math.floor(o / 3)]! : t > 0 ? segment[t - 1]! : 0;
    let other = -1;
    let differing = 0;
    for (let i = 2; i >= 0; --i) {
      const there = latest[vertex[c + i]!]!;
      if (there < 0 || there === guess) continue;
      differing += 1;
      if (other < 0) other = there;
    }
    let here = guess;
    if (decoder.bit(sameModels + differing) === 0) {
      here = other >= 0 && decoder.bit(otherModels + differing) === 1 ? other : decoder.number(segmentModels);
      if (here >= header.segmentCount) throw new DecodeError("malformed", "names a segment that does not exist");
    }
    segment[t] = here;
    for (let i = 0; i < 3; ++i) {
      const v = vertex[c + i]!;
      if (latest[v]! >= 0 && latest[v] !== here) isShared[v] = 1;
      latest[v] = here;
    }
  }
  return { segment, isShared };
}
