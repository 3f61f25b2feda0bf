// Compares pictures, and writes pictures that explain a failed comparison.

import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { encodePng, type Picture } from "./png.ts";
import { outputDirectory } from "./paths.ts";

export interface Difference {
  /** Mean absolute difference, 0..255, over all pixels and their three colour channels. */
  mean: number;
  /** Share of pixels, 0..1, that have a channel that differs by more than 16. */
  offShare: number;
  /** Largest difference of a channel, 0..255. */
  largest: number;
}

export function difference(a: Picture, b: Picture): Difference {
  if (a.width !== b.width || a.height !== b.height) {
    throw new Error(`pictures of ${a.width}x${a.height} and ${b.width}x${b.height} pixels cannot be compared`);
  }
  const pixels = a.width * a.height;
  let sum = 0;
  let offCount = 0;
  let largest = 0;
  for (let pixel = 0; pixel < pixels; ++pixel) {
    const pixelDifference = channelDifferences(a, b, pixel);
    sum += pixelDifference.sum;
    offCount += pixelDifference.largest > 16 ? 1 : 0;
    largest = Math.max(largest, pixelDifference.largest);
  }
  return { mean: sum / (3 * pixels), offShare: offCount / pixels, largest };
}

function channelDifferences(a: Picture, b: Picture, pixel: number): { sum: number; largest: number } {
  let sum = 0;
  let largest = 0;
  for (let channel = 0; channel < 3; ++channel) {
    const delta = Math.abs(a.data[pixel * a.channels + channel]! - b.data[pixel * b.channels + channel]!);
    sum += delta;
    largest = Math.max(largest, delta);
  }
  return { sum, largest };
}

export interface Bounds {
  mean: number;
  offShare?: number;
}

/** Bounds for a comparison with plain buffers that hold the quantised mesh. */
export const boundsOfQuantised: Bounds = { mean: 0.01 };
/** Bounds for a comparison with plain buffers that hold the float input. */
export const boundsOfInput: Bounds = { mean: 0.05, offShare: 0.0001 };

/** The same for compact, whose normals of 8 bits differ by up to a degree (classic: 0.4), also on average by more:
 * docs/decisions/source-precision.md. */
export const boundsOfCompact: Bounds = { mean: 0.16, offShare: 0.0001 };

export function isWithin(difference: Difference, bounds: Bounds): boolean {
  return difference.mean <= bounds.mean && difference.offShare <= (bounds.offShare ?? 1);
}

/** Throws unless the pictures agree within the bounds, after writing NAME.actual.png,
 *  NAME.expected.png and NAME.difference.png (times 8) into the output directory. */
export function assertSamePicture(name: string, actual: Picture, expected: Picture, bounds: Bounds): Difference {
  const found = difference(actual, expected);
  if (isWithin(found, bounds)) return found;
  savePicture(`${name}.actual`, actual);
  savePicture(`${name}.expected`, expected);
  savePicture(`${name}.difference`, differencePicture(actual, expected));
  throw new Error(
    `${name}: mean difference ${found.mean.toFixed(4)} (bound ${bounds.mean}), ` +
      `${(found.offShare * 100).toFixed(4)} % of pixels differ by more than 16` +
      (bounds.offShare === undefined ? "" : ` (bound ${bounds.offShare * 100} %)`) +
      `; see ${join(outputDirectory, name)}.*.png`,
  );
}

export function savePicture(name: string, picture: Picture): void {
  mkdirSync(outputDirectory, { recursive: true });
  writeFileSync(join(outputDirectory, `${name}.png`), encodePng(picture));
}

function differencePicture(a: Picture, b: Picture): Picture {
  const { width, height } = a;
  const data = new Uint8Array(3 * width * height);
  for (let pixel = 0; pixel < width * height; ++pixel) {
    for (let channel = 0; channel < 3; ++channel) {
      const delta = Math.abs(a.data[pixel * a.channels + channel]! - b.data[pixel * b.channels + channel]!);
      data[3 * pixel + channel] = Math.min(255, 8 * delta);
    }
  }
  return { width, height, channels: 3, data };
}

/** A mask: 1 where a picture differs from the blank one by more than 8, 0 elsewhere. */
export function silhouette(picture: Picture, blank: Picture): Uint8Array {
  const mask = new Uint8Array(picture.width * picture.height);
  for (let pixel = 0; pixel < mask.length; ++pixel)
    mask[pixel] = channelDifferences(picture, blank, pixel).largest > 8 ? 1 : 0;
  return mask;
}

/** Number of pixels that are in exactly one of two silhouettes, divided by the pixels of the first. */
export function silhouetteDifference(a: Uint8Array, b: Uint8Array): number {
  let covered = 0;
  let different = 0;
  for (let pixel = 0; pixel < a.length; ++pixel) {
    covered += a[pixel]!;
    different += a[pixel] === b[pixel] ? 0 : 1;
  }
  return different / covered;
}

/** Number of pixels outside the silhouette that are not connected to the border of the picture. */
export function holesIn(mask: Uint8Array, width: number): number {
  const height = mask.length / width;
  const reached = Uint8Array.from(mask);
  const open: number[] = [];
  const visit = (x: number, y: number): void => {
    if (x < 0 || y < 0 || x >= width || y >= height || reached[y * width + x] === 1) return;
    reached[y * width + x] = 1;
    open.push(y * width + x);
  };
  for (let x = 0; x < width; ++x)
    [0, height - 1].forEach((y) => {
      visit(x, y);
    });
  for (let y = 0; y < height; ++y)
    [0, width - 1].forEach((x) => {
      visit(x, y);
    });
  for (let pixel = open.pop(); pixel !== undefined; pixel = open.pop()) {
    const x = pixel % width;
    const y = (pixel - x) / width;
    visit(x - 1, y);
    visit(x + 1, y);
    visit(x, y - 1);
    visit(x, y + 1);
  }
  return reached.reduce((holes, seen) => holes + (1 - seen), 0);
}
