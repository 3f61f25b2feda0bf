// A decoded base as what a GPU takes, each part for itself: it goes when its patch comes.

import type { ElementArray, VertexArray } from "../arrays.ts";
import { DecodeError } from "../decodeError.ts";
import type { CompactPatch } from "./patch.ts";
import type { PatchBuffers } from "./patchBuffers.ts";
import { indexOf, verticesOf } from "./patchBuffers.ts";

/** Of each part, in order; undefined where one has no triangles. */
export type BaseBuffers = (PatchBuffers | undefined)[];

/** Throws DecodeError for what is no base. */
export function baseBuffersOf(base: CompactPatch): BaseBuffers {
  const { header, parts, wedges: { wedge } } = base;
  if (parts === undefined) throw new DecodeError("malformed", "holds a patch where a base should be");
  const { firsts, triangles } = trianglesByPart(parts.part, header.partCount);
  const vertices = verticesOf(base);
  const numbers = new Int32Array(header.wedgeCount).fill(-1);
  return Array.from({ length: header.partCount }, (_, part) => {
    const corners = new Int32Array(3 * (firsts[part + 1]! - firsts[part]!));
    if (corners.length === 0) return undefined;
    const used: number[] = [];
    for (let c = 0; c < corners.length; ++c) {
      const w = wedge[3 * triangles[firsts[part]! + Math.floor(c / 3)]! + c % 3]!;
      if (numbers[w]! < 0) numbers[w] = used.push(w) - 1;
      corners[c] = numbers[w]!;
    }
    for (const w of used) numbers[w] = -1;
    const some = (all: VertexArray | undefined) => all && gather(all, used);
    return {
      ...vertices, vertexCount: used.length, index: indexOf(corners, used.length),
      coord: gather(vertices.coord, used), normal: some(vertices.normal), color: some(vertices.color), texCoord: some(vertices.texCoord),
      others: vertices.others.map((other) => ({ ...other, vertices: gather(other.vertices, used) })),
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
