// Wedges: positions with their attributes, the vertices of the GPU
// (docs/formats/compact.md, "Wedges"). Only where attributes have seams is there
// anything to decode.

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
const farSteps = 15; // the wedge is named by its number

export interface Wedges {
  /** Per corner. In points there are no corners. */
  readonly wedge: Int32Array;
  /** Undefined where each vertex is one wedge. */
  readonly seams: Seams | undefined;
}

export interface Seams {
  /** Per wedge: the corner that it came with. */
  readonly corner: Int32Array;
  /** Per wedge: the one made before it at its vertex, or -1. */
  readonly previous: Int32Array;
  /** Per vertex: 1 where it may have several. */
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
  /** Per wedge. `ring` links those of a vertex in a circle. */
  readonly #corner: Int32Array;
  readonly #previous: Int32Array;
  readonly #ring: Int32Array;
  /** Per vertex: its first wedge, the one made last, the one met last, and how many there are beyond the first. */
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
      let splits = 0; // of this element's corners so far
      let differ = 0; // those that their guess was wrong for
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

  /** The wedge that the neighbour across an edge has here. */
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

  /** Another wedge of a vertex than the one that was guessed. */
  #differing(c: number, v: number, guess: number): number {
    const decoder = this.#decoder;
    const ring = this.#ring;
    const extra = this.#extra[v]!;
    if (decoder.bit(madeModels + Math.min(extra, 2)) === 1) return this.#make(c, v);
    if (extra === 0) throw new DecodeError("malformed", "names another wedge of a vertex that has one");
    const steps = extra === 1 ? 0 : decoder.tree(stepModels, 4);
    let w = guess;
    if (steps < farSteps) {
      for (let step = 0; step <= steps; ++step) w = ring[w]!;
      return w;
    }
    w = this.#count - 1 - decoder.number(wedgeModels);
    if (w < 0 || this.#vertex[this.#corner[w]!] !== v)
      throw new DecodeError("malformed", "names a wedge that its vertex has not");
    return w;
  }

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
