// A decoded base as what a GPU takes: whole for the first look, each part for itself
// for those after it, since a part goes when its patch comes.

import type { ElementArray, VertexArray } from "../../stage/vertexArray.ts";
import { DecodeError } from "../decodeError.ts";
import type { CompactPatch } from "./patch.ts";
import type { PatchBuffers } from "./patchBuffers.ts";
import { indexOf, verticesOf } from "./patchBuffers.ts";

/** Of each part, in order; undefined where one has no triangles. */
export type BaseBuffers = (PatchBuffers | undefined)[];

export class Base {
  readonly segmentCount: number;
  /** All parts in one. */
  readonly whole: PatchBuffers;
  readonly #part: Int32Array;
  readonly #wedge: Int32Array;
  #parts: BaseBuffers | undefined;

  /** Throws DecodeError for what is no base. */
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

  /** Its parts, made when they are first asked for. */
  get segments(): BaseBuffers {
    return (this.#parts ??= partsOf(this.whole, this.#wedge, this.#part, this.segmentCount));
  }
}

function partsOf(whole: PatchBuffers, wedge: Int32Array, part: Int32Array, partCount: number): BaseBuffers {
  const { firsts, triangles } = trianglesByPart(part, partCount);
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

/** Triangle numbers, those of part p from firsts[p] up to firsts[p + 1]. */
function trianglesByPart(part: Int32Array, partCount: number): { firsts: Int32Array; triangles: Int32Array } {
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

/** The records with these numbers. */
function gather(all: VertexArray, numbers: readonly number[]): VertexArray {
  const { array, stride } = all;
  const some = new (array.constructor as new (length: number) => ElementArray)(numbers.length * stride);
  numbers.forEach((from, to) => {
    for (let i = 0; i < stride; ++i) some[to * stride + i] = array[from * stride + i]!;
  });
  return { ...all, array: some };
}
