// Bits and prefix codes of lossless WebP (RFC 9649, 3.7).

import { DecodeError } from "../decodeError.ts";

/** Reads the bits of a bitstream, the lowest bit of each byte first. */
export class BitReader {
  readonly #bytes: Uint8Array;
  /** In bits. */
  #position = 0;

  constructor(bytes: Uint8Array) {
    this.#bytes = bytes;
  }

  /** A number of up to 24 bits. Throws DecodeError at the end. */
  read(bits: number): number {
    const value = this.peek(bits);
    this.skip(bits);
    return value;
  }

  /** The next bits, up to 24; beyond the end they are 0. */
  peek(bits: number): number {
    const bytes = this.#bytes;
    const at = this.#position >>> 3;
    const word =
      (bytes[at] ?? 0) | ((bytes[at + 1] ?? 0) << 8) | ((bytes[at + 2] ?? 0) << 16) | ((bytes[at + 3] ?? 0) << 24);
    return (word >>> (this.#position & 7)) & ((1 << bits) - 1);
  }

  skip(bits: number): void {
    this.#position += bits;
    if (this.#position > 8 * this.#bytes.length) throw new DecodeError("truncated", "ends inside its image");
  }
}

const maxCodeLength = 15;
/** Codes of at most so many bits are looked up. */
const tableBits = 7;

/** A canonical prefix code: which symbol the next bits stand for. */
export class PrefixCode {
  /** The symbol of a code without bits, which has no other. */
  readonly #only: number | undefined;
  /** By length: number of codes. */
  readonly #counts = new Uint16Array(maxCodeLength + 1);
  /** In the order of their codes. */
  readonly #symbols: Uint16Array;
  /** By the next bits: 16 times the symbol, plus the length of its code; 0 for longer codes. */
  readonly #table = new Uint16Array(1 << tableBits);

  /** `lengths`: those of the codes, by symbol; 0: the symbol has none. Throws DecodeError. */
  constructor(lengths: Uint8Array) {
    for (const length of lengths) this.#counts[length] = this.#countOf(length) + 1;
    this.#counts[0] = 0;
    const firsts = new Uint16Array(maxCodeLength + 2);
    let free = 1 << maxCodeLength;
    for (let length = 1; length <= maxCodeLength; ++length) {
      const count = this.#countOf(length);
      firsts[length + 1] = (firsts[length] ?? 0) + count;
      free -= count << (maxCodeLength - length);
    }
    const symbolCount = firsts[maxCodeLength + 1] ?? 0;
    this.#symbols = new Uint16Array(symbolCount);
    lengths.forEach((length, symbol) => {
      if (length === 0) return;
      const at = firsts[length] ?? 0;
      this.#symbols[at] = symbol;
      firsts[length] = at + 1;
    });
    this.#only = symbolCount === 1 ? this.#symbols[0] : undefined;
    if (symbolCount !== 1 && free !== 0) throw new DecodeError("malformed", "has a code with too many or too few bits");
    this.#fillTable();
  }

  #countOf(length: number): number {
    return this.#counts[length] ?? 0;
  }

  #fillTable(): void {
    let code = 0;
    let at = 0;
    for (let length = 1; length <= tableBits; ++length, code <<= 1)
      for (let n = this.#countOf(length); n > 0; --n, ++code) {
        const entry = ((this.#symbols[at++] ?? 0) << 4) | length;
        for (let next = reversed(code, length); next < 1 << tableBits; next += 1 << length) this.#table[next] = entry;
      }
  }

  read(bits: BitReader): number {
    if (this.#only !== undefined) return this.#only;
    const entry = this.#table[bits.peek(tableBits)] ?? 0;
    if (entry !== 0) {
      bits.skip(entry & 15);
      return entry >> 4;
    }
    const next = bits.peek(maxCodeLength);
    for (let length = 1, code = 0, first = 0, at = 0; length <= maxCodeLength; ++length) {
      code = (code << 1) | ((next >> (length - 1)) & 1);
      const count = this.#countOf(length);
      if (code - first < count) {
        bits.skip(length);
        return this.#symbols[at + code - first] ?? 0;
      }
      at += count;
      first = (first + count) << 1;
    }
    throw new DecodeError("malformed", "has a code that stands for nothing");
  }
}

/** The bits in the other order. */
function reversed(code: number, length: number): number {
  let result = 0;
  for (let bit = 0; bit < length; ++bit) result |= ((code >> bit) & 1) << (length - 1 - bit);
  return result;
}

const lengthSymbols = [17, 18, 0, 1, 2, 3, 4, 5, 16, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15] as const;

/** Reads a code for symbols 0 … symbolCount - 1. */
export function readPrefixCode(bits: BitReader, symbolCount: number): PrefixCode {
  return new PrefixCode(bits.read(1) === 1 ? simpleLengths(bits, symbolCount) : codedLengths(bits, symbolCount));
}

/** One or two symbols. */
function simpleLengths(bits: BitReader, symbolCount: number): Uint8Array {
  const lengths = new Uint8Array(symbolCount);
  const isPair = bits.read(1) === 1;
  const symbols = [bits.read(bits.read(1) === 1 ? 8 : 1)];
  if (isPair) symbols.push(bits.read(8));
  for (const symbol of symbols) {
    if (symbol >= symbolCount) throw new DecodeError("malformed", "has a code for a symbol that does not exist");
    lengths[symbol] = 1;
  }
  return lengths;
}

function codedLengths(bits: BitReader, symbolCount: number): Uint8Array {
  const lengthLengths = new Uint8Array(lengthSymbols.length);
  const lengthCount = 4 + bits.read(4);
  if (lengthCount > lengthSymbols.length) throw new DecodeError("malformed", "has too many lengths of codes");
  for (const symbol of lengthSymbols.slice(0, lengthCount)) lengthLengths[symbol] = bits.read(3);
  const code = new PrefixCode(lengthLengths);
  let left = bits.read(1) === 1 ? 2 + bits.read(2 + 2 * bits.read(3)) : symbolCount;
  if (left > symbolCount) throw new DecodeError("malformed", "has codes for symbols that do not exist");

  const lengths = new Uint8Array(symbolCount);
  let previous = 8;
  for (let symbol = 0; symbol < symbolCount && left > 0; --left) {
    const length = code.read(bits);
    if (length < 16) {
      lengths[symbol++] = length;
      if (length > 0) previous = length;
      continue;
    }
    const count = length === 16 ? 3 + bits.read(2) : length === 17 ? 3 + bits.read(3) : 11 + bits.read(7);
    if (count > symbolCount - symbol) throw new DecodeError("malformed", "has codes for symbols that do not exist");
    if (length === 16) lengths.fill(previous, symbol, symbol + count);
    symbol += count;
  }
  return lengths;
}
