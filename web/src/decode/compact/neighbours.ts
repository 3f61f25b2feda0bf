// Finds the neighbouring wedges that attribute values are predicted from: docs/formats/compact.md, "Attributes".

import type { Connectivity } from "./connectivity.ts";
import { after, before } from "./connectivity.ts";
import type { Topology } from "./header.ts";
import type { Positions } from "./positions.ts";
import type { RangeDecoder } from "./rangeDecoder.ts";
import type { PatchHeader } from "./sizes.ts";
import type { Wedges } from "./wedges.ts";

/** A patch without its attributes, which are decoded last. */
export interface DecodedShape extends Positions {
  readonly header: PatchHeader;
  readonly connectivity: Connectivity;
  readonly wedges: Wedges;
}

/** The wedges around a wedge that are decoded before it, -1 where there is none. `find` sets them. */
export class Neighbours {
  /** At the next and the previous corner of its first triangle. In lines, `a` is the other end and `b` is -1. */
  a = -1;
  b = -1;
  /** Opposite the edge of a and b, in the triangle across it. */
  o = -1;
  readonly #topology: Topology;
  readonly #wedge: Int32Array;
  readonly #across: Int32Array;
  /** Per wedge: the first corner that has it. */
  readonly #corner: Int32Array;

  constructor({ header, connectivity, wedges: { wedge, seams } }: DecodedShape) {
    this.#topology = header.topology;
    this.#wedge = wedge;
    this.#across = connectivity.across;
    this.#corner = seams?.corner ?? firstCornersOf(wedge, header.vertexCount);
  }

  /** Finds the neighbours of wedge w. */
  find(w: number): void {
    const wedge = this.#wedge;
    this.a = this.b = this.o = -1;
    if (this.#topology === "points") return;
    const c = this.#corner[w]!;
    if (this.#topology === "lines") {
      if (c % 2 === 1 && wedge[c - 1]! < w) this.a = wedge[c - 1]!;
      return;
    }
    const a = wedge[after(c)]!;
    const b = wedge[before(c)]!;
    if (a < w) this.a = a;
    if (b < w) this.b = b;
    if (a >= w || b >= w || c % 3 !== 2) return;
    const o = this.#across[(c - 2) / 3]!;
    if (o >= 0 && wedge[after(o)] === b && wedge[before(o)] === a) this.o = wedge[o]!;
  }
}

/** Per wedge: 1 where it has the value of the previous wedge of its vertex. Empty where every vertex has one wedge. */
export function decodeRepeats(decoder: RangeDecoder, model: number, { seams }: Wedges): Uint8Array {
  if (seams === undefined) return new Uint8Array();
  const repeats = new Uint8Array(seams.previous.length);
  for (let w = 0; w < repeats.length; ++w) if (seams.previous[w]! >= 0) repeats[w] = decoder.bit(model);
  return repeats;
}

/** The first corner of each vertex; vertices are numbered in the order of their first corners. */
function firstCornersOf(vertex: Int32Array, vertexCount: number): Int32Array {
  const corner = new Int32Array(vertex.length > 0 ? vertexCount : 0);
  let next = 0;
  for (let c = 0; next < corner.length; ++c) if (vertex[c] === next) corner[next++] = c;
  return corner;
}
