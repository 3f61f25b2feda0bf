// Images of lossless WebP that are coded by prefix codes: references to earlier pixels, a cache of colours, and colours
// (RFC 9649, 3.5 to 3.7).

import { DecodeError } from "../decodeError.ts";
import { type BitReader, type PrefixCode, readPrefixCode } from "./bits.ts";

/** Pixels as numbers with alpha, red, green and blue from the highest byte to the lowest, row by row from the top. */
export interface CodedImage {
  readonly width: number;
  readonly height: number;
  readonly pixels: Uint32Array<ArrayBuffer>;
}

/** What holds for blocks of 2^bits by 2^bits pixels: a pixel for each. */
export interface BlockMap {
  readonly bits: number;
  readonly blocks: CodedImage;
}

/** How many blocks of 2^bits pixels cover a width or a height. */
export function blocksOf(length: number, bits: number): number {
  return (length + (1 << bits) - 1) >> bits;
}

const literalCount = 256;
const lengthCodeCount = 24;
const distanceCodeCount = 40;
const maxCacheBits = 11;

/** Codes of green, lengths and cached colours, of red, blue, alpha, and distances. */
type CodeGroup = readonly [PrefixCode, PrefixCode, PrefixCode, PrefixCode, PrefixCode];

/** `isMain`: whether it is the image itself, whose blocks may have groups of codes of their own. */
export function readCodedImage(bits: BitReader, width: number, height: number, isMain: boolean): CodedImage {
  const cacheBits = bits.read(1) === 1 ? bits.read(4) : 0;
  if (cacheBits > maxCacheBits) throw new DecodeError("malformed", "has too large a cache of colours");
  const map = isMain && bits.read(1) === 1 ? readBlockMap(bits, width, height) : undefined;
  const groupCount = map ? 1 + map.blocks.pixels.reduce((max, pixel) => Math.max(max, groupIn(pixel)), 0) : 1;
  if (map && groupCount > map.blocks.pixels.length)
    throw new DecodeError("malformed", "has more groups of codes than blocks");
  const cacheSize = cacheBits > 0 ? 1 << cacheBits : 0;
  const groups = Array.from({ length: groupCount }, (): CodeGroup => [
    readPrefixCode(bits, literalCount + lengthCodeCount + cacheSize),
    readPrefixCode(bits, literalCount),
    readPrefixCode(bits, literalCount),
    readPrefixCode(bits, literalCount),
    readPrefixCode(bits, distanceCodeCount),
  ]);
  const pixels = new Uint32Array(width * height);
  const groupAt = (at: number): CodeGroup => {
    const group = groups[map ? groupIn(pixelOfBlock(map, at % width, Math.floor(at / width))) : 0];
    if (group === undefined) throw new DecodeError("malformed", "has no code for a block");
    return group;
  };
  // Groups change at blocks alone.
  const sameGroup = map === undefined ? Infinity : (1 << map.bits) - 1;
  readPixels(bits, { pixels, width, cacheBits, groupAt, sameGroup });
  return { width, height, pixels };
}

export function readBlockMap(bits: BitReader, width: number, height: number): BlockMap {
  const blockBits = 2 + bits.read(3);
  const blocks = readCodedImage(bits, blocksOf(width, blockBits), blocksOf(height, blockBits), false);
  return { bits: blockBits, blocks };
}

/** The pixel that stands for the block of a pixel. */
export function pixelOfBlock({ bits, blocks }: BlockMap, column: number, row: number): number {
  return blocks.pixels[(row >> bits) * blocks.width + (column >> bits)] ?? 0;
}

const groupIn = (pixel: number): number => (pixel >>> 8) & 0xffff;

interface PixelReading {
  readonly pixels: Uint32Array;
  readonly width: number;
  readonly cacheBits: number;
  readonly groupAt: (at: number) => CodeGroup;
  /** Pixels whose columns differ in these bits alone have the same group. */
  readonly sameGroup: number;
}

function readPixels(bits: BitReader, { pixels, width, cacheBits, groupAt, sameGroup }: PixelReading): void {
  const cache = new Uint32Array(1 << cacheBits);
  const keep = (pixel: number): void => {
    cache[Math.imul(0x1e35a7bd, pixel) >>> (32 - cacheBits)] = pixel;
  };
  let group = groupAt(0);
  for (let at = 0; at < pixels.length;) {
    const column = at % width;
    if (column === 0 || (column & sameGroup) === 0) group = groupAt(at);
    const [greenCode, redCode, blueCode, alphaCode, distanceCode] = group;
    const symbol = greenCode.read(bits);
    if (symbol < literalCount) {
      const red = redCode.read(bits);
      const blue = blueCode.read(bits);
      const pixel = ((alphaCode.read(bits) << 24) | (red << 16) | (symbol << 8) | blue) >>> 0;
      pixels[at++] = pixel;
      if (cacheBits > 0) keep(pixel);
    } else if (symbol < literalCount + lengthCodeCount) {
      const length = readLength(bits, symbol - literalCount);
      const distance = distanceOf(readLength(bits, distanceCode.read(bits)), width);
      if (distance > at || length > pixels.length - at)
        throw new DecodeError("malformed", "refers to pixels that do not exist");
      for (const end = at + length; at < end; ++at) {
        const pixel = pixels[at - distance] ?? 0;
        pixels[at] = pixel;
        if (cacheBits > 0) keep(pixel);
      }
      if (at < pixels.length) group = groupAt(at);
    } else pixels[at++] = cache[symbol - literalCount - lengthCodeCount] ?? 0;
  }
}

/** A length or the number of a distance: a symbol says how many bits follow. */
function readLength(bits: BitReader, symbol: number): number {
  if (symbol < 4) return symbol + 1;
  const extra = (symbol - 2) >> 1;
  return ((2 + (symbol & 1)) << extra) + bits.read(extra) + 1;
}

/** Steps to the left and up to the pixels around one, the nearest first. */
const nearPixels = Array.from({ length: 8 * 16 }, (_, n) => [8 - (n % 16), n >> 4] as const)
  .filter(([left, up]) => up > 0 || left > 0)
  .sort(([a, b], [c, d]) => a * a + b * b - c * c - d * d || Math.abs(a) - Math.abs(c) || c - a);

/** The distance in pixels, row by row, of its number. */
function distanceOf(number: number, width: number): number {
  const near = nearPixels[number - 1];
  return near === undefined ? number - nearPixels.length : Math.max(1, near[0] + near[1] * width);
}
