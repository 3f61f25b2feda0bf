// Decodes the wedge of each corner. A wedge is a vertex with its attributes, that is, a vertex of the GPU
// (docs/formats/compact.md, "Wedges"). Only patches whose attributes have seams store wedges.

import { DecodeError } from "../decodeError.ts";
import type { Connectivity } from "./connectivity.ts";
import { after, before } from "./connectivity.ts";
import type { RangeDecoder } from "./rangeDecoder.ts";
import { numberModelCount } from "./rangeDecoder.ts";
import type { PatchHeader } from "./sizes.ts";

const splitModels = 0;
const sameModels = splitModels + 3;
const madeModels = sameModels + 9;
const stepModels = madeModels + 3;
const wedgeModels = stepModels + 16;
export const wedgeModelCount = wedgeModels + numberModelCount;
const maxStepCount = 15; // stands for a wedge that is coded by its index

export interface Wedges {
  /** Per corner; empty for points. */
  readonly wedge: Int32Array;
  /** Undefined if every vertex has one wedge. */
  readonly seams: Seams | undefined;
}

export interface Seams {
  /** Per wedge: the first corner that has it. */
  readonly corner: Int32Array;
  /** Per wedge: the previous new wedge of its vertex, or -1. */
  readonly previous: Int32Array;
  /** Per vertex: 1 where it may have several wedges. */
  readonly isSplit: Uint8Array;
}

/** Safe for untrusted bytes. Throws DecodeError. */
export function decodeWedges(decoder: RangeDecoder, header: PatchHeader, connectivity: Connectivity): Wedges {
  return new WedgeDecoder(decoder, header, connectivity).run();
}

class WedgeDecoder {
  readonly #decoder: RangeDecoder;
  readonly #isTriangles: boolean;
  readonly #vertex: Int32Array;
  readonly #across: Int32Array;
  readonly #closing: Int32Array;
  readonly #wedge: Int32Array;
  /** Per wedge; `ring` links the wedges of each vertex in a circle. */
  readonly #corner: Int32Array;
  readonly #previous: Int32Array;
  readonly #ring: Int32Array;
  /** Per vertex: its first wedge, the newest one, the one of the latest corner, and the count beyond the first. */
  readonly #first: Int32Array;
  readonly #newest: Int32Array;
  readonly #latest: Int32Array;
  readonly #extra: Int32Array;
  readonly #isSplit: Uint8Array;
  #count = 0;

  constructor(
    decoder: RangeDecoder,
    { topology, vertexCount, wedgeCount }: PatchHeader,
    { vertex, across, closing }: Connectivity,
  ) {
    this.#decoder = decoder;
    this.#isTriangles = topology === "triangles";
    this.#vertex = vertex;
    this.#across = across;
    this.#closing = closing;
    this.#wedge = new Int32Array(vertex.length);
    this.#corner = new Int32Array(wedgeCount);
    this.#previous = new Int32Array(wedgeCount);
    this.#ring = new Int32Array(wedgeCount);
    this.#first = new Int32Array(vertexCount).fill(-1);
    this.#newest = new Int32Array(vertexCount);
    this.#latest = new Int32Array(vertexCount);
    this.#extra = new Int32Array(vertexCount);
    this.#isSplit = new Uint8Array(vertexCount);
  }

  run(): Wedges {
    const vertex = this.#vertex;
    const wedge = this.#wedge;
    const first = this.#first;
    const isSplit = this.#isSplit;
    const corners = this.#isTriangles ? 3 : 2;
    for (let element = 0; element < vertex.length; element += corners) {
      let splits = 0; // split vertices of this element so far
      let differ = 0; // corners of this element whose guess was wrong
      for (let i = 0; i < corners; ++i) {
        const c = element + i;
        const v = vertex[c]!;
        if (first[v]! < 0) {
          wedge[c] = this.#make(c, v);
          isSplit[v] = this.#decoder.bit(splitModels + splits);
        } else if (isSplit[v] === 0) {
          wedge[c] = first[v]!;
        } else {
          const guess = this.#guess(c, i, v);
          const isSame = this.#decoder.bit(sameModels + Math.min(this.#extra[v]!, 2) * 3 + differ) === 1;
          wedge[c] = isSame ? guess : this.#differing(c, v, guess);
          if (!isSame) ++differ;
        }
        this.#latest[v] = wedge[c]!;
        splits += isSplit[v]!;
      }
    }
    if (this.#count < this.#corner.length)
      throw new DecodeError("malformed", "holds fewer wedges than its header states");
    return { wedge: this.#wedge, seams: { corner: this.#corner, previous: this.#previous, isSplit } };
  }

  /** Predicts the wedge of corner c: the one at the vertex in the triangle across an edge, or else the latest one. */
  #guess(c: number, i: number, v: number): number {
    const wedge = this.#wedge;
    if (this.#isTriangles) {
      const t = (c - i) / 3;
      const across = this.#across[t]!;
      const closing = this.#closing[t]!;
      if (i < 2 && across >= 0) return wedge[i === 0 ? before(across) : after(across)]!;
      if (i === 2 && closing >= 0) return wedge[this.#vertex[after(closing)] === v ? after(closing) : before(closing)]!;
    }
    return this.#latest[v]!;
  }

  /** Decodes the wedge of corner c where it is not the guess. */
  #differing(c: number, v: number, guess: number): number {
    const decoder = this.#decoder;
    const ring = this.#ring;
    const extra = this.#extra[v]!;
    if (decoder.bit(madeModels + Math.min(extra, 2)) === 1) return this.#make(c, v);
    if (extra === 0) throw new DecodeError("malformed", "names another wedge of a vertex that has one");
    const steps = extra === 1 ? 0 : decoder.tree(stepModels, 4);
    let w = guess;
    if (steps < maxStepCount) {
      for (let step = 0; step <= steps; ++step) w = ring[w]!;
      return w;
    }
    w = this.#count - 1 - decoder.number(wedgeModels);
    if (w < 0 || this.#vertex[this.#corner[w]!] !== v)
      throw new DecodeError("malformed", "names a wedge that its vertex does not have");
    return w;
  }

  /** Adds a wedge of vertex v, first used at corner c. */
  #make(c: number, v: number): number {
    const w = this.#count++;
    if (w >= this.#corner.length) throw new DecodeError("malformed", "holds more wedges than its header states");
    const first = this.#first[v]!;
    const ring = this.#ring;
    if (first < 0) {
      ring[w] = w;
      this.#first[v] = w;
      this.#previous[w] = -1;
    } else {
      ring[w] = ring[first]!;
      ring[first] = w;
      this.#previous[w] = this.#newest[v]!;
      this.#extra[v] = this.#extra[v]! + 1;
    }
    this.#newest[v] = w;
    this.#corner[w] = c;
    return w;
  }
}
