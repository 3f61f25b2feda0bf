// Decodes one stream of a file: adaptive bits from its front, raw bits from its back (docs/formats/compact.md,
// "Stream"; Martin, "Range encoding", 1979; the two ends as in Opus, RFC 6716). The state is in fields of a class:
// variables captured by closures took a third longer.

import { DecodeError } from "../decodeError.ts";

/** Number of models that `number`, `signed` and `small` use. */
export const numberModelCount = 32;

/** Safe for untrusted bytes: every call returns or throws DecodeError. */
export class RangeDecoder {
  /** Per model: 32 times the probability of a 1, in 1/65536, plus the number of bits decoded with it, up to 31. */
  readonly #models: Int32Array;
  readonly #bytes: Uint8Array;
  #front = 3;
  #back: number;
  #range = 0xffffff;
  #code: number;
  #rawBits = 0;
  #rawBitCount = 0;

  constructor(bytes: Uint8Array, modelCount: number) {
    if (bytes.length < 3) throw crossed();
    this.#models = new Int32Array(modelCount).fill(1 << 20);
    this.#bytes = bytes;
    this.#back = bytes.length;
    this.#code = (bytes[0]! << 16) | (bytes[1]! << 8) | bytes[2]!;
  }

  /** Reads one adaptive bit. */
  bit(model: number): 0 | 1 {
    const models = this.#models;
    const state = models[model]!;
    const probability = state >>> 5;
    const count = state & 31;
    const shift = 32 - Math.clz32(count + 1);
    const next = count < 31 ? count + 1 : 31;
    const range = this.#range;
    const bound = Math.imul(range >>> 8, probability) >>> 8;
    if (this.#code < bound) {
      models[model] = ((probability + ((65536 - probability) >>> shift)) << 5) | next;
      this.#range = bound;
      if (bound < 65536) this.#shiftIn();
      return 1;
    }
    models[model] = ((probability - (probability >>> shift)) << 5) | next;
    this.#code -= bound;
    this.#range = range - bound;
    if (range - bound < 65536) this.#shiftIn();
    return 0;
  }

  /** Reads `count` raw bits, 0 … 30. */
  raw(count: number): number {
    if (count > 16) return this.raw(16) | (this.raw(count - 16) << 16);
    while (this.#rawBitCount < count) {
      if (this.#back <= this.#front) throw crossed();
      this.#back -= 1;
      this.#rawBits |= this.#bytes[this.#back]! << this.#rawBitCount;
      this.#rawBitCount += 8;
    }
    const value = this.#rawBits & ((1 << count) - 1);
    this.#rawBits >>>= count;
    this.#rawBitCount -= count;
    return value;
  }

  /** Reads a number 0 … 2^depth - 1 with the models from `models` + 1 on. */
  tree(models: number, depth: number): number {
    // The same as in `bit`, with the state in local variables: this takes half of the time.
    const states = this.#models;
    const leaves = 1 << depth;
    let range = this.#range;
    let code = this.#code;
    let node = 1;
    while (node < leaves) {
      const model = models + node;
      const state = states[model]!;
      const probability = state >>> 5;
      const count = state & 31;
      const shift = 32 - Math.clz32(count + 1);
      const next = count < 31 ? count + 1 : 31;
      const bound = Math.imul(range >>> 8, probability) >>> 8;
      node <<= 1;
      if (code < bound) {
        states[model] = ((probability + ((65536 - probability) >>> shift)) << 5) | next;
        range = bound;
        node |= 1;
      } else {
        states[model] = ((probability - (probability >>> shift)) << 5) | next;
        code -= bound;
        range -= bound;
      }
      if (range < 65536) {
        this.#range = range;
        this.#code = code;
        this.#shiftIn();
        range = this.#range;
        code = this.#code;
      }
    }
    this.#range = range;
    this.#code = code;
    return node - leaves;
  }

  /** Reads a number 0 … 2^30 - 1. */
  number(models: number): number {
    const length = this.#length(models);
    return length === 0 ? 0 : (1 << (length - 1)) | this.raw(length - 1);
  }

  /** Reads a number -(2^30 - 1) … 2^30 - 1. */
  signed(models: number): number {
    return this.#rest(this.#length(models));
  }

  /** Reads a number of the same range, whose bit after the first is adaptive: model `nextBit` + its bit length. */
  longSigned(models: number, nextBit: number): number {
    const length = this.#length(models);
    if (length < 2) return this.#rest(length);
    const first = 2 | this.bit(nextBit + length);
    const rest = this.raw(length - 1);
    const magnitude = (first << (length - 2)) | (rest >>> 1);
    return (rest & 1) === 0 ? magnitude : -magnitude;
  }

  /** Reads a number of the same range, stored in fewer bits if it is mostly 0. */
  small(models: number): number {
    let length = 0;
    while (length < 30 && this.bit(models + length) === 0) ++length;
    return this.#rest(length);
  }

  /** To be called when everything is read. Throws DecodeError where bytes are left. */
  finish(): void {
    if (this.#front !== this.#back)
      throw new DecodeError("malformed", "holds a stream that is longer than what is in it");
  }

  /** Reads the bit length of a number. */
  #length(models: number): number {
    const length = this.tree(models, 4);
    return length < 15 ? length : 15 + this.tree(models + 16, 4);
  }

  /** Reads the bits after the first of a number of this bit length, and its sign. */
  #rest(length: number): number {
    if (length === 0) return 0;
    const rest = this.raw(length);
    const magnitude = (1 << (length - 1)) | (rest >>> 1);
    return (rest & 1) === 0 ? magnitude : -magnitude;
  }

  #shiftIn(): void {
    do {
      if (this.#front >= this.#back) throw crossed();
      this.#range <<= 8;
      this.#code = (this.#code << 8) | this.#bytes[this.#front]!;
      this.#front += 1;
    } while (this.#range < 65536);
  }
}

/** The error for a front end that meets the back end. */
function crossed(): DecodeError {
  return new DecodeError("malformed", "holds a stream that is shorter than what is in it");
}

/** The bit length of a magnitude, 0 … 2^32 - 1. */
export function bitLength(magnitude: number): number {
  return 32 - Math.clz32(magnitude);
}
