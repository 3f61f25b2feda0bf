// Decodes texture coordinates. Each is predicted by laying out its triangle in the texture, beside the known edge and
// with the angles that it has in space (docs/formats/compact.md, "Texture coordinates").

import { DecodeError } from "../decodeError.ts";
import { choiceModels, firstModels, repeatModel, secondModels } from "./attributeModels.ts";
import type { AttributeType } from "./header.ts";
import type { DecodedShape } from "./neighbours.ts";
import { decodeRepeats, Neighbours } from "./neighbours.ts";
import type { RangeDecoder } from "./rangeDecoder.ts";
import { bitLength, numberModelCount } from "./rangeDecoder.ts";

/** Maximum bits of an edge's components; longer edges are shortened, so that products stay exact. */
const maxEdgeBits = 12;

/** u, v of each wedge, each 0 … 2^bits - 1. Safe for untrusted bytes. Throws DecodeError. */
export function decodeTexCoords(decoder: RangeDecoder, type: AttributeType, shape: DecodedShape): Int32Array {
  const repeats = decodeRepeats(decoder, repeatModel, shape.wedges);
  const previous = shape.wedges.seams?.previous;
  const texCoords = new Int32Array(2 * shape.header.wedgeCount);
  const texCoordDecoder = new TexCoordDecoder(decoder, type, shape, texCoords);
  for (let w = 0; w < shape.header.wedgeCount; ++w) {
    if (repeats.length > 0 && repeats[w] === 1) {
      texCoords[2 * w] = texCoords[2 * previous![w]!]!;
      texCoords[2 * w + 1] = texCoords[2 * previous![w]! + 1]!;
    } else {
      texCoordDecoder.decode(w);
    }
  }
  return texCoords;
}

class TexCoordDecoder {
  readonly #decoder: RangeDecoder;
  readonly #maxStored: number;
  readonly #shape: DecodedShape;
  readonly #texCoords: Int32Array;
  readonly #neighbours: Neighbours;
  /** The predicted value. */
  #u = 0;
  #v = 0;
  #lastChoice = 0;

  constructor(decoder: RangeDecoder, { bits }: AttributeType, shape: DecodedShape, texCoords: Int32Array) {
    this.#decoder = decoder;
    this.#maxStored = 2 ** bits - 1;
    this.#shape = shape;
    this.#texCoords = texCoords;
    this.#neighbours = new Neighbours(shape);
  }

  decode(w: number): void {
    const decoder = this.#decoder;
    this.#predict(w);
    const first = decoder.signed(firstModels);
    const second = decoder.signed(secondModels + numberModelCount * bitLength(Math.abs(first)));
    const u = Math.min(Math.max(this.#u, 0), this.#maxStored) + first;
    const v = Math.min(Math.max(this.#v, 0), this.#maxStored) + second;
    if (u < 0 || v < 0 || u > this.#maxStored || v > this.#maxStored) {
      throw new DecodeError("malformed", "holds a texture coordinate that its bits cannot hold");
    }
    this.#texCoords[2 * w] = u;
    this.#texCoords[2 * w + 1] = v;
  }

  #predict(w: number): void {
    const texCoords = this.#texCoords;
    const neighbours = this.#neighbours;
    neighbours.find(w);
    const { a, b, o } = neighbours;
    if (a >= 0 && b >= 0) {
      const choice = this.#choose(o >= 0 ? 2 : 1);
      this.#lastChoice = choice;
      if (choice < 2) {
        this.#layOut(w, choice === 0 ? 1 : -1);
        return;
      }
      this.#u = texCoords[2 * a]! + texCoords[2 * b]! - texCoords[2 * o]!;
      this.#v = texCoords[2 * a + 1]! + texCoords[2 * b + 1]! - texCoords[2 * o + 1]!;
      return;
    }
    this.#lastChoice = 0;
    const known = a >= 0 ? a : b >= 0 ? b : w - 1;
    this.#u = known >= 0 ? texCoords[2 * known]! : (this.#maxStored + 1) / 2;
    this.#v = known >= 0 ? texCoords[2 * known + 1]! : (this.#maxStored + 1) / 2;
  }

  /** Reads which of `set` + 1 candidates the encoder chose. */
  #choose(set: 1 | 2): number {
    const models = choiceModels + (set * 4 + this.#lastChoice) * 2;
    let choice = 0;
    while (choice < set && this.#decoder.bit(models + choice) === 0) ++choice;
    return choice;
  }

  /** Predicts the third corner of the triangle that is laid out on one side of the edge from a to b. */
  #layOut(w: number, side: 1 | -1): void {
    const { coordinates } = this.#shape;
    const { a, b } = this.#neighbours;
    const texCoords = this.#texCoords;
    const xw = 3 * this.#vertexOf(w);
    const xa = 3 * this.#vertexOf(a);
    const xb = 3 * this.#vertexOf(b);
    let ex = coordinates[xb]! - coordinates[xa]!;
    let ey = coordinates[xb + 1]! - coordinates[xa + 1]!;
    let ez = coordinates[xb + 2]! - coordinates[xa + 2]!;
    let fx = coordinates[xw]! - coordinates[xa]!;
    let fy = coordinates[xw + 1]! - coordinates[xa + 1]!;
    let fz = coordinates[xw + 2]! - coordinates[xa + 2]!;
    const largest = Math.max(Math.abs(ex), Math.abs(ey), Math.abs(ez), Math.abs(fx), Math.abs(fy), Math.abs(fz));
    const shift = Math.max(0, bitLength(largest) - maxEdgeBits);
    ex >>= shift;
    ey >>= shift;
    ez >>= shift;
    fx >>= shift;
    fy >>= shift;
    fz >>= shift;
    const e = ex * ex + ey * ey + ez * ez;
    const f = ex * fx + ey * fy + ez * fz;
    const height = side * Math.floor(Math.sqrt(e * (fx * fx + fy * fy + fz * fz) - f * f));
    const du = texCoords[2 * b]! - texCoords[2 * a]!;
    const dv = texCoords[2 * b + 1]! - texCoords[2 * a + 1]!;
    this.#u = texCoords[2 * a]!;
    this.#v = texCoords[2 * a + 1]!;
    if (e === 0) return;
    this.#u += Math.floor((2 * (f * du - height * dv) + e) / (2 * e));
    this.#v += Math.floor((2 * (f * dv + height * du) + e) / (2 * e));
  }

  #vertexOf(w: number): number {
    const {
      connectivity,
      wedges: { seams },
    } = this.#shape;
    return seams ? connectivity.vertex[seams.corner[w]!]! : w;
  }
}
