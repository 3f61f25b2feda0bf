// Encodes streams for tests of the decoder, by the inverse of docs/formats/compact.md, "Stream". Slow and simple, so
// that it can be compared with the text.

const one = 1 << 24;

export class TestEncoder {
  readonly #models: Int32Array;
  readonly #front: number[] = [];
  readonly #rawBits: number[] = [];
  #low = 0;
  #range = 0xffffff;

  constructor(modelCount: number) {
    this.#models = new Int32Array(modelCount).fill(1 << 20);
  }

  bit(model: number, value: boolean): void {
    const probability = this.#models[model]! >>> 5;
    const count = this.#models[model]! & 31;
    const shift = Math.floor(Math.log2(count + 1)) + 1;
    const bound = Math.floor((Math.floor(this.#range / 256) * probability) / 256);
    const moved = value ? probability + ((65536 - probability) >>> shift) : probability - (probability >>> shift);
    this.#models[model] = (moved << 5) | Math.min(count + 1, 31);
    if (value) {
      this.#range = bound;
    } else {
      this.#low += bound;
      this.#range -= bound;
      this.#carry();
    }
    for (; this.#range < 65536; this.#range *= 256) this.#shiftOut();
  }

  raw(count: number, value: number): void {
    for (let i = 0; i < count; ++i) this.#rawBits.push((value >>> i) & 1);
  }

  tree(models: number, depth: number, value: number): void {
    for (let node = 1, level = depth - 1; level >= 0; --level) {
      const bit = (value >>> level) & 1;
      this.bit(models + node, bit === 1);
      node = (node << 1) | bit;
    }
  }

  number(models: number, value: number): void {
    const length = lengthOf(value);
    this.#length(models, length);
    if (length > 0) this.raw(length - 1, value - 2 ** (length - 1));
  }

  signed(models: number, value: number): void {
    const length = lengthOf(value);
    this.#length(models, length);
    this.#rest(length, value);
  }

  small(models: number, value: number): void {
    const length = lengthOf(value);
    for (let i = 0; i < Math.min(length + 1, 30); ++i) this.bit(models + i, i === length);
    this.#rest(length, value);
  }

  longSigned(models: number, nextBit: number, value: number): void {
    const length = lengthOf(value);
    this.#length(models, length);
    if (length < 2) {
      this.#rest(length, value);
      return;
    }
    const half = 2 ** (length - 2);
    const isSet = Math.abs(value) - 2 * half >= half;
    this.bit(nextBit + length, isSet);
    this.raw(length - 1, 2 * (Math.abs(value) % half) + Number(value < 0));
  }

  finish(): Uint8Array<ArrayBuffer> {
    for (let i = 0; i < 3; ++i) this.#shiftOut();
    const back: number[] = [];
    this.#rawBits.forEach((bit, i) => {
      back[i >>> 3] = (back[i >>> 3] ?? 0) | (bit << (i & 7));
    });
    return Uint8Array.from([...this.#front, ...back.reverse()]);
  }

  #length(models: number, length: number): void {
    this.tree(models, 4, Math.min(length, 15));
    if (length >= 15) this.tree(models + 16, 4, length - 15);
  }

  #rest(length: number, value: number): void {
    if (length > 0) this.raw(length, 2 * (Math.abs(value) - 2 ** (length - 1)) + Number(value < 0));
  }

  #shiftOut(): void {
    this.#front.push(Math.floor(this.#low / 65536));
    this.#low = (this.#low % 65536) * 256;
  }

  #carry(): void {
    if (this.#low < one) return;
    this.#low -= one;
    let digit = this.#front.length - 1;
    for (; this.#front[digit] === 255; --digit) this.#front[digit] = 0;
    this.#front[digit] = this.#front[digit]! + 1;
  }
}

/** The bit length of a magnitude. */
function lengthOf(value: number): number {
  return value === 0 ? 0 : Math.floor(Math.log2(Math.abs(value))) + 1;
}

/** Pseudorandom numbers, the same in every run: Marsaglia, "Xorshift RNGs", 2003. */
export class TestRandom {
  #state: number;

  constructor(seed: number) {
    this.#state = Math.imul(seed + 1, 0x9e3779b1) | 1;
  }

  /** A number 0 … limit - 1. */
  below(limit: number): number {
    this.#state ^= this.#state << 13;
    this.#state ^= this.#state >>> 17;
    this.#state ^= this.#state << 5;
    return (this.#state >>> 0) % limit;
  }
}
