// Decodes SIG classic on the CPU (paper, section 5.2): converts the images of a patch to arrays for buffers. Stored
// integers become the numbers that the vertex shader would read (render/shaders/vertexChunk.ts), so that both paths
// draw the same. Pure functions, for workers.

import { makeIndex } from "../indexArray.ts";
import type { IndexArray, VertexArray } from "../../stage/vertexArray.ts";
import { DecodeError } from "../decodeError.ts";
import type { Pixels } from "../imagePixels.ts";
import { decodePixels } from "../imagePixels.ts";
import type { DrawRange, NormalFormat, StatedDrawRange } from "../../stage/stage.ts";
import { isPairFormat } from "../../stage/stage.ts";
import { drawnPrimitives } from "../drawnPrimitives.ts";

/** A file, and the texel at which its data begin. */
export interface ImageFile {
  readonly bytes: Uint8Array<ArrayBuffer>;
  readonly firstTexel: number;
}

/** Where the records of a patch are in its images. */
export interface RecordLayout {
  readonly count: number;
  /** Record r is texel (r mod rowLength, r div rowLength); if rowLength is 0, it is texel r, row by row. */
  readonly rowLength: number;
}

interface PlanesJob extends RecordLayout {
  /** The available byte planes, most significant first. */
  readonly planes: readonly ImageFile[];
}

export interface CoordJob extends PlanesJob {
  /** Number of byte planes of the complete patch. */
  readonly planeCount: number;
  /** Added to every coordinate for the missing bytes. */
  readonly missingBytesMidpoint: number;
}

/** Decodes coordinates to stored integers; as Float32 if planes are missing or there are more than two. */
export async function classicCoords(job: CoordJob): Promise<VertexArray> {
  const { planes, planeCount, missingBytesMidpoint, count } = job;
  const sums = await sumsOf(job, 3, 3);
  const isWhole = planes.length === planeCount;
  const array =
    isWhole && planeCount === 1
      ? new Uint8Array(count * 4)
      : isWhole && planeCount === 2
        ? new Uint16Array(count * 4)
        : new Float32Array(count * 3);
  const stride = array instanceof Float32Array ? 3 : 4;
  const shift = 256 ** (planeCount - planes.length);
  for (let record = 0; record < count; ++record) {
    for (let axis = 0; axis < 3; ++axis)
      array[record * stride + axis] = (sums[3 * record + axis] ?? 0) * shift + missingBytesMidpoint;
  }
  return { array, components: 3, stride, offset: 0 };
}

/** Combines the available byte planes to `stride` numbers for each record, of which the first `channels` are set. */
export async function sumsOf(
  { planes, count, rowLength }: PlanesJob,
  channels: 1 | 2 | 3 | 4,
  stride: number,
): Promise<Float64Array> {
  const images = await Promise.all(planes.map((plane) => imageOf(plane, channels)));
  const sums = new Float64Array(count * stride);
  for (const image of images) {
    const { data } = image;
    const texelOf = texelsOf(image, { count, rowLength });
    for (let record = 0; record < count; ++record) {
      const at = texelOf(record) * image.channels;
      for (let channel = 0; channel < channels; ++channel) {
        sums[stride * record + channel] = (sums[stride * record + channel] ?? 0) * 256 + (data[at + channel] ?? 0);
      }
    }
  }
  return sums;
}

export interface ValueJob extends PlanesJob {
  readonly components: 1 | 2 | 3 | 4;
  /** By component: the minimum and the extent of the range that stored integers cover. */
  readonly min: readonly number[];
  readonly size: readonly number[];
}

/** Decodes the numbers of an attribute, of which all planes are available. */
export async function classicValues({ components, min, size, ...job }: ValueJob): Promise<VertexArray> {
  const sums = await sumsOf(job, components, components);
  const maxStored = 256 ** job.planes.length - 1;
  const array = Float32Array.from(
    sums,
    (stored, i) => (min[i % components] ?? 0) + ((size[i % components] ?? 0) * stored) / maxStored,
  );
  return { array, components, stride: components, offset: 0 };
}

export interface IndexJob {
  readonly file: ImageFile;
  /** Element n is texel (n mod rowLength, n div rowLength), counted from the first texel of the data. */
  readonly rowLength: number;
  readonly draws: readonly StatedDrawRange[];
  /** Whether the front of triangles is counterclockwise. */
  readonly ccw: boolean;
  /** Texels hold the index of the record; otherwise its column and row in 256ths of the coordinate image. */
  readonly isWide: boolean;
  readonly coordWidth: number;
  readonly coordHeight: number;
  readonly recordCount: number;
}

/** Decodes the index, with its primitives converted to those that are drawn, and returns the draws that match it. */
export async function classicIndex(job: IndexJob): Promise<{ index: IndexArray; draws: readonly DrawRange[] }> {
  const { file, rowLength, draws, ccw, isWide, coordWidth, coordHeight, recordCount } = job;
  const count = draws.reduce((sum, draw) => sum + draw.count, 0);
  const image = await imageOf(file, 3);
  const texelOf = texelsOf(image, { count, rowLength });
  const index = makeIndex(recordCount, count);
  const { data, channels } = image;
  for (let n = 0; n < count; ++n) {
    const at = texelOf(n) * channels;
    const [r = 0, g = 0, b = 0] = [data[at], data[at + 1], data[at + 2]];
    const record = isWide
      ? r + 256 * g + 65536 * b
      : ((g * coordHeight + 128) >> 8) * coordWidth + ((r * coordWidth + 128) >> 8);
    if (record >= recordCount)
      throw new DecodeError("malformed", `holds index ${record} where there are ${recordCount} vertices`);
    index[n] = record;
  }
  return drawnPrimitives(index, draws, ccw);
}

export interface NormalJob extends RecordLayout {
  readonly file: ImageFile;
  readonly format: NormalFormat;
}

/**
 * Decodes normals: to the three bytes of a vector, or to a pair. Of a pair of bytes, the first is in the upper half of
 * the image and the second in the lower half; a texel has both numbers of a pair of words.
 */
export async function classicNormals({ file, format, ...layout }: NormalJob): Promise<VertexArray> {
  if (!isPairFormat(format)) return bytesOf(await imageOf(file, 3), layout, 3);
  if (format.bits === 16) return wordsOf(await imageOf(file, 4), layout);
  const image = await imageOf(file, 1);
  const { data, channels } = image;
  const half = (image.width * image.height) / 2;
  requireTexels(image, half + layout.count);
  const array = new Uint8Array(layout.count * 4);
  for (let record = 0; record < layout.count; ++record) {
    array[4 * record] = data[(image.firstTexel + record) * channels] ?? 0;
    array[4 * record + 1] = data[(image.firstTexel + half + record) * channels] ?? 0;
  }
  return { array, components: 2, stride: 4, offset: 0 };
}

export interface TexCoordJob extends PlanesJob {
  /** Bits of each number in the first image. Further images have the next lower bytes. */
  readonly firstBits: 8 | 16;
}

/** Decodes texture coordinates to fractions of 8, 16 or, of two images, 24 bits. */
export async function classicTexCoords({ planes, firstBits, ...layout }: TexCoordJob): Promise<VertexArray> {
  const [first, low] = planes;
  if (first === undefined) throw new DecodeError("truncated", "has no image of texture coordinates");
  if (firstBits === 8) return { ...bytesOf(await imageOf(first, 3), layout, 3), components: 2 };
  const words = wordsOf(await imageOf(first, 4), layout);
  if (low === undefined) return words;
  const lowBytes = bytesOf(await imageOf(low, 3), layout, 3).array;
  const array = new Float32Array(layout.count * 2);
  for (let n = 0; n < array.length; ++n)
    array[n] = (256 * (words.array[n] ?? 0) + (lowBytes[4 * (n >> 1) + (n & 1)] ?? 0)) / 0xffffff;
  return { array, components: 2, stride: 2, offset: 0 };
}

/** Two 16-bit numbers of each record: red and blue are the bytes of the first, green and alpha those of the second. */
function wordsOf(image: DataPixels, layout: RecordLayout): VertexArray {
  const texelOf = texelsOf(image, layout);
  const { data, channels } = image;
  const array = new Uint16Array(layout.count * 2);
  for (let record = 0; record < layout.count; ++record) {
    const at = texelOf(record) * channels;
    array[2 * record] = 256 * (data[at] ?? 0) + (data[at + 2] ?? 0);
    array[2 * record + 1] = 256 * (data[at + 1] ?? 0) + (data[at + 3] ?? 0);
  }
  return { array, components: 2, stride: 2, offset: 0 };
}

export interface ColorJob extends RecordLayout {
  readonly file: ImageFile;
  readonly components: 3 | 4;
}

/** Decodes colours to bytes, four for each record. */
export async function classicColors({ file, components, ...layout }: ColorJob): Promise<VertexArray> {
  return bytesOf(await imageOf(file, components), layout, components);
}

export interface WordJob extends PlanesJob {
  readonly components: 3 | 4;
  /** Words stand for -1 … 1, otherwise for 0 … 1. */
  readonly isSigned: boolean;
}

/**
 * Decodes an attribute of several byte planes: up to two of them to 16-bit words, three to fractions. Without the lower
 * ones a byte b stands for 257 b.
 */
export async function classicWords({ components, isSigned, ...job }: WordJob): Promise<VertexArray> {
  const sums = await sumsOf(job, components, components);
  if (job.planes.length > 2) {
    const array = Float32Array.from(sums, (sum) => sum / 0xffffff);
    return { array, components, stride: components, offset: 0 };
  }
  const wordOf = (sum: number) => (job.planes.length === 1 ? 257 * sum : sum);
  const stride = 4; // WebGL reads records of whole multiples of four bytes faster
  const array = isSigned ? new Int16Array(job.count * stride) : new Uint16Array(job.count * stride);
  for (let record = 0; record < job.count; ++record) {
    for (let n = 0; n < components; ++n) {
      const word = wordOf(sums[components * record + n] ?? 0);
      array[stride * record + n] = isSigned ? Math.round(((2 * word) / 65535 - 1) * 32767) : word;
    }
  }
  return { array, components, stride, offset: 0 };
}

/** Pixels, and the texel at which the data begin. */
interface DataPixels extends Pixels {
  readonly firstTexel: number;
}

async function imageOf({ bytes, firstTexel }: ImageFile, minChannels: number): Promise<DataPixels> {
  const pixels = await decodePixels(bytes);
  if (pixels.channels < minChannels)
    throw new DecodeError("malformed", `has ${pixels.channels} channels where ${minChannels} are needed`);
  return { ...pixels, firstTexel };
}

function bytesOf(image: DataPixels, layout: RecordLayout, components: 3 | 4): VertexArray {
  const texelOf = texelsOf(image, layout);
  const { data, channels } = image;
  const array = new Uint8Array(layout.count * 4);
  for (let record = 0; record < layout.count; ++record) {
    const at = texelOf(record) * channels;
    for (let n = 0; n < components; ++n) array[4 * record + n] = data[at + n] ?? 0;
  }
  return { array, components, stride: 4, offset: 0 };
}

/** Returns the function from records to texels of the image. Throws if the image has too few texels. */
function texelsOf(image: DataPixels, { count, rowLength }: RecordLayout): (n: number) => number {
  const { width, firstTexel: first } = image;
  const texelIndexOf =
    rowLength === 0 || rowLength === width
      ? (n: number) => first + n
      : (n: number) => first + Math.floor(n / rowLength) * width + (n % rowLength);
  if (rowLength > width) throw new DecodeError("malformed", `is ${width} texels wide, rows of ${rowLength} do not fit`);
  if (count > 0) requireTexels(image, texelIndexOf(count - 1) - first + 1);
  return texelIndexOf;
}

function requireTexels({ width, height, firstTexel: first }: DataPixels, count: number): void {
  if (first + count > width * height) {
    throw new DecodeError("malformed", `has ${width} x ${height} texels; ${count} from texel ${first} on do not fit`);
  }
}
