// Converts a decoded base mesh to arrays for the GPU: whole for the preview, and by segment for the runtime, which
// replaces each segment when its patch arrives.

import { byVertexRole } from "../../stage/attributeRows.ts";
import type { ElementArray, VertexArray } from "../../stage/vertexArray.ts";
import { DecodeError } from "../decodeError.ts";
import type { DecodedPatch, SegmentsOfTriangles } from "./decodedFile.ts";
import type { PatchBuffers } from "./patchBuffers.ts";
import { indexOf } from "./patchBuffers.ts";

/** The buffers of each segment, in order; undefined for a segment without triangles. */
export type BaseBuffers = (PatchBuffers | undefined)[];

/** A decoded base mesh. */
export class Base {
  readonly segmentCount: number;
  /** All segments in one. */
  readonly whole: PatchBuffers;
  readonly decoded: DecodedPatch;
  readonly #segments: SegmentsOfTriangles;
  #buffers: BaseBuffers | undefined;

  /** Throws DecodeError for a patch that is no base mesh. */
  constructor(decoded: DecodedPatch) {
    const { buffers, segments } = decoded;
    this.decoded = decoded;
    if (segments === undefined) throw new DecodeError("malformed", "holds a patch where a base should be");
    this.segmentCount = segments.segmentCount;
    this.whole = buffers;
    this.#segments = segments;
  }

  /** The buffers of each segment, computed on first use. */
  get segments(): BaseBuffers {
    return (this.#buffers ??= segmentsOf(this.whole, this.#segments));
  }
}

function segmentsOf(whole: PatchBuffers, { segment, segmentCount }: SegmentsOfTriangles): BaseBuffers {
  const wedge = whole.index!;
  const { firsts, triangles } = trianglesBySegment(segment, segmentCount);
  const newIndices = new Int32Array(whole.vertexCount).fill(-1);
  return Array.from({ length: segmentCount }, (_, s) => {
    const corners = new Int32Array(3 * (firsts[s + 1]! - firsts[s]!));
    if (corners.length === 0) return undefined;
    const used: number[] = [];
    for (let c = 0; c < corners.length; ++c) {
      const w = wedge[3 * triangles[firsts[s]! + Math.floor(c / 3)]! + (c % 3)]!;
      if (newIndices[w]! < 0) newIndices[w] = used.push(w) - 1;
      corners[c] = newIndices[w]!;
    }
    for (const w of used) newIndices[w] = -1;
    const gathered = (all: VertexArray | undefined) => all && gather(all, used);
    return {
      ...whole,
      vertexCount: used.length,
      index: indexOf(corners, used.length),
      coord: gather(whole.coord, used),
      attributes: byVertexRole((role) => gathered(whole.attributes[role])),
      others: whole.others.map((other) => ({ ...other, vertices: gather(other.vertices, used) })),
    };
  });
}

/** Triangle indices by segment: those of segment s from firsts[s] up to firsts[s + 1]. */
export function trianglesBySegment(
  segment: Int32Array,
  segmentCount: number,
): { firsts: Int32Array; triangles: Int32Array } {
  const firsts = new Int32Array(segmentCount + 1);
  for (const s of segment) firsts[s + 1] = firsts[s + 1]! + 1;
  for (let s = 0; s < segmentCount; ++s) firsts[s + 1] = firsts[s + 1]! + firsts[s]!;
  const next = firsts.slice();
  const triangles = new Int32Array(segment.length);
  for (let t = 0; t < segment.length; ++t) {
    const s = segment[t]!;
    triangles[next[s]!] = t;
    next[s] = next[s]! + 1;
  }
  return { firsts, triangles };
}

/** The records with these indices. */
function gather(all: VertexArray, indices: readonly number[]): VertexArray {
  const { array, stride } = all;
  const gathered = new (array.constructor as new (length: number) => ElementArray)(indices.length * stride);
  indices.forEach((from, to) => {
    for (let i = 0; i < stride; ++i) gathered[to * stride + i] = array[from * stride + i]!;
  });
  return { ...all, array: gathered };
}
