// The transforms of lossless WebP, from the pixels that are stored to those of the image (RFC 9649, 3.4).

import { DecodeError } from "../decodeError.ts";
import type { BitReader } from "./bits.ts";
import { blocksOf, pixelOfBlock, readBlockMap, readCodedImage } from "./entropyCoded.ts";
import type { BlockMap, CodedImage } from "./entropyCoded.ts";

/** Returns the pixels before the transform was applied, as wide as the image was then. */
export type InverseTransform = (stored: CodedImage) => CodedImage;

const black = 0xff000000;

/** Transforms in the order in which they are to be inverted, and the width of the image that is stored. */
export function readTransforms(
  bits: BitReader,
  width: number,
  height: number,
): { readonly transforms: readonly InverseTransform[]; readonly storedWidth: number } {
  const transforms: InverseTransform[] = [];
  const found = new Set<number>();
  let storedWidth = width;
  while (bits.read(1) === 1) {
    const type = bits.read(2);
    if (found.has(type)) throw new DecodeError("malformed", "has a transform twice");
    found.add(type);
    if (type === 2) transforms.unshift(addGreen);
    else if (type === 3) {
      const { transform, packedWidth } = readPalette(bits, storedWidth);
      transforms.unshift(transform);
      storedWidth = packedWidth;
    } else {
      const map = readBlockMap(bits, storedWidth, height);
      transforms.unshift((stored) => (type === 0 ? addPredictions : addColors)(stored, map));
    }
  }
  return { transforms, storedWidth };
}

/** Blue and red were stored without green. */
function addGreen(stored: CodedImage): CodedImage {
  stored.pixels.forEach((pixel, at) => {
    const green = (pixel >>> 8) & 0xff;
    stored.pixels[at] = sumOf(pixel, (green << 16) | green);
  });
  return stored;
}

/** Sums of the four channels, each modulo 256. */
function sumOf(a: number, b: number): number {
  const alphaAndGreen = ((a & 0xff00ff00) + (b & 0xff00ff00)) & 0xff00ff00;
  return (alphaAndGreen | (((a & 0x00ff00ff) + (b & 0x00ff00ff)) & 0x00ff00ff)) >>> 0;
}

/** Red and blue were stored without shares of green, and blue without one of red, by blocks. */
function addColors(stored: CodedImage, map: BlockMap): CodedImage {
  const { pixels, width } = stored;
  pixels.forEach((pixel, at) => {
    const shares = pixelOfBlock(map, at % width, Math.floor(at / width));
    const green = pixel >>> 8;
    const red = ((pixel >>> 16) + shareOf(shares, green)) & 0xff;
    const blue = (pixel + shareOf(shares >>> 8, green) + shareOf(shares >>> 16, red)) & 0xff;
    pixels[at] = ((pixel & 0xff00ff00) | (red << 16) | blue) >>> 0;
  });
  return stored;
}

/** The lowest bytes of both are signed; a share is in units of 1 / 32. */
function shareOf(share: number, color: number): number {
  return (((share << 24) >> 24) * ((color << 24) >> 24)) >> 5;
}

/** Pixels were stored as differences from predictions by their neighbours, in modes by blocks. */
function addPredictions(stored: CodedImage, map: BlockMap): CodedImage {
  const { pixels, width } = stored;
  for (let at = 0; at < pixels.length; ++at) {
    const column = at % width;
    const pixelBefore = (distance: number): number => pixels[at - distance] ?? black;
    let prediction = pixelBefore(at < width ? 1 : width); // in the first row, and the first column
    if (at >= width && column > 0)
      prediction = predictionOf((pixelOfBlock(map, column, Math.floor(at / width)) >>> 8) & 15, {
        left: pixelBefore(1),
        top: pixelBefore(width),
        topLeft: pixelBefore(width + 1),
        topRight: pixelBefore(width - 1), // of the last column: the first pixel of its own row
      });
    pixels[at] = sumOf(pixels[at] ?? 0, prediction);
  }
  return stored;
}

interface Neighbours {
  readonly left: number;
  readonly top: number;
  readonly topLeft: number;
  readonly topRight: number;
}

function predictionOf(mode: number, { left, top, topLeft, topRight }: Neighbours): number {
  switch (mode) {
    case 1:
      return left;
    case 2:
      return top;
    case 3:
      return topRight;
    case 4:
      return topLeft;
    case 5:
      return meanOf(meanOf(left, topRight), top);
    case 6:
      return meanOf(left, topLeft);
    case 7:
      return meanOf(left, top);
    case 8:
      return meanOf(topLeft, top);
    case 9:
      return meanOf(top, topRight);
    case 10:
      return meanOf(meanOf(left, topLeft), meanOf(top, topRight));
    case 11:
      return distanceOf(top, topLeft) < distanceOf(left, topLeft) ? left : top;
    case 12:
      return byChannel((channel) => channel(left) + channel(top) - channel(topLeft));
    case 13: {
      const mean = meanOf(left, top);
      return byChannel((channel) => channel(mean) + Math.trunc((channel(mean) - channel(topLeft)) / 2));
    }
    default:
      return black;
  }
}

/** By channel, rounded down. */
function meanOf(a: number, b: number): number {
  return ((((a ^ b) & 0xfefefefe) >>> 1) + (a & b)) >>> 0;
}

/** The sum of the differences of the channels. */
function distanceOf(a: number, b: number): number {
  let sum = 0;
  for (let shift = 0; shift < 32; shift += 8) sum += Math.abs(((a >>> shift) & 0xff) - ((b >>> shift) & 0xff));
  return sum;
}

/** A pixel of the four values, each limited to 0 … 255. */
function byChannel(valueOf: (channel: (pixel: number) => number) => number): number {
  let pixel = 0;
  for (let shift = 0; shift < 32; shift += 8) {
    const value = valueOf((pixel) => (pixel >>> shift) & 0xff);
    pixel |= Math.min(255, Math.max(0, value)) << shift;
  }
  return pixel >>> 0;
}

/** Pixels were stored as numbers of colours, several in a pixel where there are few colours. */
function readPalette(bits: BitReader, width: number): { transform: InverseTransform; packedWidth: number } {
  const size = 1 + bits.read(8);
  const colors = readCodedImage(bits, size, 1, false).pixels;
  for (let n = 1; n < size; ++n) colors[n] = sumOf(colors[n] ?? 0, colors[n - 1] ?? 0);
  const packing = size <= 2 ? 3 : size <= 4 ? 2 : size <= 16 ? 1 : 0;
  const bitsOfNumber = 8 >> packing;
  const transform: InverseTransform = ({ pixels, width: packedWidth, height }) => {
    const unpacked = new Uint32Array(width * height);
    for (let row = 0, at = 0; row < height; ++row)
      for (let column = 0; column < width; ++column, ++at) {
        const green = ((pixels[row * packedWidth + (column >> packing)] ?? 0) >>> 8) & 0xff;
        const shift = (column & ((1 << packing) - 1)) * bitsOfNumber;
        unpacked[at] = colors[(green >> shift) & ((1 << bitsOfNumber) - 1)] ?? 0;
      }
    return { width, height, pixels: unpacked };
  };
  return { transform, packedWidth: blocksOf(width, packing) };
}
