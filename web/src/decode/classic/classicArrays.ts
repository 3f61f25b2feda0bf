// Classic SIG on the CPU (paper, section 5.2): the images of a patch to the arrays
// that buffers are made of. Stored integers come out as the vertex shader would
// read them (render/vertexChunk.ts), so that both ways show the same picture.
// Pure functions, to be run in workers.

import type { IndexArray, VertexArray } from "../../stage/vertexArray.ts";
import { DecodeError } from "../decodeError.ts";
import type { Pixels } from "../pngPixels.ts";
import { decodePixels } from "../pngPixels.ts";
import type { DrawRange, NormalCode } from "../../stage/stage.ts";
import { isPairCode } from "../../stage/stage.ts";
import { withoutStrips } from "../strips.ts";

/** A file, and the texel that its data begin at. */
export interface ImageFile {
  readonly png: Uint8Array<ArrayBuffer>;
  readonly firstTexel: number;
}

/** Where the records of a patch lie in its images. */
export interface RecordLayout {
  readonly count: number;
  /** Record r is texel (r mod rowLength, r div rowLength), or texel r where it is 0. */
  readonly rowLength: number;
}

interface PlanesJob extends RecordLayout {
  /** The byte planes that are here, most significant first. */
  readonly planes: readonly ImageFile[];
}

export interface CoordJob extends PlanesJob {
  /** The byte planes that there will be. */
  readonly planeCount: number;
  /** Added to every coordinate for the missing bytes. */
  readonly missingBytesMidpoint: number;
}

/** Stored integers; in Float32 where bytes are missing or there are more than two. */
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

/** The bytes that are here put together, `stride` numbers a record, of which the first `channels` count. */
export async function sumsOf(
  { planes, count, rowLength }: PlanesJob,
  channels: 1 | 2 | 3 | 4,
  stride: number,
): Promise<Float64Array> {
  const images = await Promise.all(planes.map((plane) => imageOf(plane, channels)));
  const sums = new Float64Array(count * stride);
  for (const image of images) {
    const { data } = image;
    const texelOf = placesOf(image, { count, rowLength });
    for (let record = 0; record < count; ++record) {
      const at = texelOf(record) * image.channels;
      for (let axis = 0; axis < channels; ++axis) {
        sums[stride * record + axis] = (sums[stride * record + axis] ?? 0) * 256 + (data[at + axis] ?? 0);
      }
    }
  }
  return sums;
}

export interface ValueJob extends PlanesJob {
  readonly components: 1 | 2 | 3 | 4;
  /** By component: the box over which stored integers are spread. */
  readonly min: readonly number[];
  readonly size: readonly number[];
}

/** The numbers themselves, of an attribute of which all planes are here. */
export async function classicValues({ components, min, size, ...job }: ValueJob): Promise<VertexArray> {
  const sums = await sumsOf(job, components, components);
  const largest = 256 ** job.planes.length - 1;
  const array = Float32Array.from(
    sums,
    (stored, i) => (min[i % components] ?? 0) + ((size[i % components] ?? 0) * stored) / largest,
  );
  return { array, components, stride: components, offset: 0 };
}

export interface IndexJob {
  readonly file: ImageFile;
  /** Element n is texel (n mod rowLength, n div rowLength), counted from the file's first. */
  readonly rowLength: number;
  readonly draws: readonly DrawRange[];
  /** Texels hold the record's number; otherwise its column and row in 256ths of the coordinate image. */
  readonly isWide: boolean;
  readonly coordWidth: number;
  readonly coordHeight: number;
  readonly recordCount: number;
}

/** The index with strips taken apart, and the draws that go with it. */
export async function classicIndex(job: IndexJob): Promise<{ index: IndexArray; draws: readonly DrawRange[] }> {
  const { file, rowLength, draws, isWide, coordWidth, coordHeight, recordCount } = job;
  const count = draws.reduce((sum, draw) => sum + draw.count, 0);
  const image = await imageOf(file, 3);
  const texelOf = placesOf(image, { count, rowLength });
  const index = recordCount <= 2 ** 16 ? new Uint16Array(count) : new Uint32Array(count);
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
  return withoutStrips(index, draws);
}

export interface NormalJob extends RecordLayout {
  readonly file: ImageFile;
  readonly code: NormalCode;
}

/** Bytes: three of a vector, or the two numbers of which the second stand in the image's lower half. */
export async function classicNormals({ file, code, ...layout }: NormalJob): Promise<VertexArray> {
  if (!isPairCode(code)) return bytesOf(await imageOf(file, 3), layout, 3);
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

export interface TexCoordJob extends RecordLayout {
  readonly file: ImageFile;
}

/** Words: red and blue are the bytes of u, green and alpha those of v. */
export async function classicTexCoords({ file, ...layout }: TexCoordJob): Promise<VertexArray> {
  const image = await imageOf(file, 4);
  const texelOf = placesOf(image, layout);
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

export async function classicColors({ file, components, ...layout }: ColorJob): Promise<VertexArray> {
  return bytesOf(await imageOf(file, components), layout, components);
}

interface FirstPixels extends Pixels {
  readonly firstTexel: number;
}

async function imageOf({ png, firstTexel: first }: ImageFile, least: number): Promise<FirstPixels> {
  const pixels = await decodePixels(png);
  if (pixels.channels < least)
    throw new DecodeError("malformed", `has ${pixels.channels} channels where ${least} are needed`);
  return { ...pixels, firstTexel: first };
}

function bytesOf(image: FirstPixels, layout: RecordLayout, components: 3 | 4): VertexArray {
  const texelOf = placesOf(image, layout);
  const { data, channels } = image;
  const array = new Uint8Array(layout.count * 4);
  for (let record = 0; record < layout.count; ++record) {
    const at = texelOf(record) * channels;
    for (let n = 0; n < components; ++n) array[4 * record + n] = data[at + n] ?? 0;
  }
  return { array, components, stride: 4, offset: 0 };
}

/** From numbers to texels of the image; throws where it has fewer. */
function placesOf(image: FirstPixels, { count, rowLength }: RecordLayout): (n: number) => number {
  const { width, firstTexel: first } = image;
  const texelIndexOf =
    rowLength === 0 || rowLength === width
      ? (n: number) => first + n
      : (n: number) => first + Math.floor(n / rowLength) * width + (n % rowLength);
  if (rowLength > width) throw new DecodeError("malformed", `is ${width} texels wide, rows of ${rowLength} do not fit`);
  if (count > 0) requireTexels(image, texelIndexOf(count - 1) - first + 1);
  return texelIndexOf;
}

function requireTexels({ width, height, firstTexel: first }: FirstPixels, count: number): void {
  if (first + count > width * height) {
    throw new DecodeError("malformed", `has ${width} x ${height} texels; ${count} from texel ${first} on do not fit`);
  }
}
