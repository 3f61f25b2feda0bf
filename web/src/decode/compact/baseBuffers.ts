// Converts a decoded base mesh to arrays for the GPU: whole for the preview, and by segment for the runtime, which replaces
// each segment when its patch arrives.

import type { ElementArray, VertexArray } from "../../stage/vertexArray.ts";
import { DecodeError } from "../decodeError.ts";
import type { CompactPatch } from "./patch.ts";
import type { PatchBuffers } from "./patchBuffers.ts";
import { indexOf, verticesOf } from "./patchBuffers.ts";

/** The buffers of each segment, in order; undefined for a segment without triangles. */
export type BaseBuffers = (PatchBuffers | undefined)[];

export class Base {
  readonly segmentCount: number;
  /** All segments in one. */
  readonly whole: PatchBuffers;
  readonly #part: Int32Array;
  readonly #wedge: Int32Array;
  #parts: BaseBuffers | undefined;

  /** Throws DecodeError for a patch that is no base mesh. */
  constructor(patch: CompactPatch) {
    const {
      header,
      segments: parts,
      wedges: { wedge },
    } = patch;
    if (parts === undefined) throw new DecodeError("malformed", "holds a patch where a base should be");
    this.segmentCount = header.segmentCount;
    this.whole = { ...verticesOf(patch), index: indexOf(wedge, header.wedgeCount) };
    this.#part = parts.segment;
    this.#wedge = wedge;
  }

  /** The buffers of each segment, computed on first use. */
  get segments(): BaseBuffers {
    return (this.#parts ??= segmentsOf(this.whole, this.#wedge, this.#part, this.segmentCount));
  }
}

function segmentsOf(whole: PatchBuffers, wedge: Int32Array, part: Int32Array, partCount: number): BaseBuffers {
  const { firsts, triangles } = trianglesBySegment(part, partCount);
  const numbers = new Int32Array(whole.vertexCount).fill(-1);
  return Array.from({ length: partCount }, (_, p) => {
    const corners = new Int32Array(3 * (firsts[p + 1]! - firsts[p]!));
    if (corners.length === 0) return undefined;
    const used: number[] = [];
    for (let c = 0; c < corners.length; ++c) {
      const w = wedge[3 * triangles[firsts[p]! + Math.floor(c / 3)]! + (c % 3)]!;
      if (numbers[w]! < 0) numbers[w] = used.push(w) - 1;
      corners[c] = numbers[w]!;
    }
    for (const w of used) numbers[w] = -1;
    const some = (all: VertexArray | undefined) => all && gather(all, used);
    return {
      ...whole,
      vertexCount: used.length,
      index: indexOf(corners, used.length),
      coord: gather(whole.coord, used),
      normal: some(whole.normal),
      color: some(whole.color),
      texCoord: some(whole.texCoord),
      others: whole.others.map((other) => ({ ...other, vertices: gather(other.vertices, used) })),
    };
  });
}

/** Triangle indices by segment: those of segment s from firsts[s] up to firsts[s + 1]. */
function trianglesBySegment(part: Int32Array, partCount: number): { firsts: Int32Array; triangles: Int32Array } {
  const firsts = new Int32Array(partCount + 1);
  for (const p of part) firsts[p + 1] = firsts[p + 1]! + 1;
  for (let p = 0; p < partCount; ++p) firsts[p + 1] = firsts[p + 1]! + firsts[p]!;
  const next = firsts.slice();
  const triangles = new Int32Array(part.length);
  for (let t = 0; t < part.length; ++t) {
    const p = part[t]!;
    triangles[next[p]!] = t;
    next[p] = next[p]! + 1;
  }
  return { firsts, triangles };
}

/** The records with these indices. */
function gather(all: VertexArray, numbers: readonly number[]): VertexArray {
  const { array, stride } = all;
  const some = new (array.constructor as new (length: number) => ElementArray)(numbers.length * stride);
  numbers.forEach((from, to) => {
    for (let i = 0; i < stride; ++i) some[to * stride + i] = array[from * stride + i]!;
  });
  return { ...all, array: some };
}
