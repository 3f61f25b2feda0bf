// Decodes a PNG to its stored bytes in JavaScript (PNG specification, W3C 2003, sections 7 to 10). A canvas would not
// return them: browsers multiply by alpha, apply colour profiles, and add noise against fingerprinting.

import { DecodeError } from "./decodeError.ts";
import { crc32 } from "./crc32.ts";
import { inflate, maxDeflateRatio } from "./inflate.ts";
import type { ImageHeader } from "./png.ts";
import { checkPng } from "./png.ts";

export interface Pixels {
  readonly width: number;
  readonly height: number;
  readonly channels: ImageHeader["channels"];
  /** Row by row from the top, `channels` bytes a texel. */
  readonly data: Uint8Array<ArrayBuffer>;
}

/** Decodes a whole PNG. Rejects with DecodeError. Safe for untrusted bytes: memory is bounded by the file's length. */
export async function decodePixels(png: Uint8Array<ArrayBuffer>): Promise<Pixels> {
  const { width, height, channels } = checkPng(png);
  const chunks = chunksOf(png);
  const palette = chunks.find(({ type }) => type === "PLTE")?.data;
  const isPalette = png[colorTypeOffset] === 3;
  if (isPalette && !isPaletteLength(palette?.length ?? 0))
    throw new DecodeError("malformed", "has no palette of 1 to 256 colours");
  const texelLength = isPalette ? 1 : channels;
  const data = await unpackedRows(chunks, { rows: height, rowLength: width * texelLength, texelLength });
  return { width, height, channels, data: isPalette ? paletteColorsOf(data, palette ?? new Uint8Array()) : data };
}

export interface PngChunk {
  readonly type: string;
  readonly data: Uint8Array<ArrayBuffer>;
}

/** The rows that the image data of a PNG holds, in bytes. */
export interface PngRows {
  readonly rows: number;
  readonly rowLength: number;
  /** Bytes of a texel, at least 1: filters refer to the texel to the left. */
  readonly texelLength: number;
}

/** Unpacks the image data, without its filters. Rejects with DecodeError: also where a chunk is damaged. */
export async function unpackedRows(
  chunks: readonly PngChunk[],
  { rows, rowLength, texelLength }: PngRows,
): Promise<Uint8Array<ArrayBuffer>> {
  for (const chunk of chunks) checkCrc(chunk);
  const packed = chunks.filter(({ type }) => type === "IDAT").map(({ data }) => data);
  const length = rows * (1 + rowLength);
  if (length > packed.reduce((sum, { length }) => sum + length, 0) * maxDeflateRatio)
    throw new DecodeError("truncated", "is too short for the size in its header");
  const [only, ...others] = packed;
  const filtered =
    (only && others.length === 0 ? unpackStored(only, length) : undefined) ?? (await inflate(packed, length));
  return unfiltered(filtered, rows, rowLength, texelLength);
}

const signatureLength = 8;
const colorTypeOffset = 25;

/** The chunks of a PNG that `checkChunks` has accepted. */
export function chunksOf(png: Uint8Array<ArrayBuffer>): PngChunk[] {
  const view = new DataView(png.buffer, png.byteOffset, png.byteLength);
  const chunks: PngChunk[] = [];
  for (let at = signatureLength; at < png.length;) {
    const length = view.getUint32(at);
    const type = String.fromCharCode(...png.subarray(at + 4, at + 8));
    chunks.push({ type, data: png.subarray(at + 8, at + 8 + length) });
    at += length + 12;
  }
  return chunks;
}

/** Throws unless the CRC after a chunk's data is that of its type and data. */
function checkCrc({ type, data }: PngChunk): void {
  const checked = new Uint8Array(data.buffer, data.byteOffset - 4, data.length + 4);
  const expectedCrc = new DataView(data.buffer, data.byteOffset + data.length, 4).getUint32(0);
  if (crc32(checked) !== expectedCrc) throw new DecodeError("malformed", `has a damaged ${type} chunk`);
}

/**
 * Unpacks a zlib stream of stored blocks, to which deflate turns incompressible bytes (RFC 1950; RFC 1951, 3.2.4).
 * Undefined for any other stream, and for one in which anything is wrong.
 */
function unpackStored(packed: Uint8Array, length: number): Uint8Array | undefined {
  const checksumLength = 4;
  if (length > packed.length) return undefined;
  const view = new DataView(packed.buffer, packed.byteOffset, packed.byteLength);
  const bytes = new Uint8Array(length);
  let at = 2;
  let filled = 0;
  if (
    packed.length < at + checksumLength ||
    (view.getUint8(0) & 15) !== 8 ||
    (view.getUint8(1) & 32) !== 0 ||
    view.getUint16(0) % 31 !== 0
  )
    return undefined;
  for (let isLast = false; !isLast;) {
    if (at + 5 + checksumLength > packed.length || view.getUint8(at) > 1) return undefined;
    isLast = view.getUint8(at) === 1;
    const size = view.getUint16(at + 1, true);
    const begin = at + 5;
    at = begin + size;
    if (
      (view.getUint16(begin - 2, true) ^ size) !== 0xffff ||
      at + checksumLength > packed.length ||
      filled + size > length
    )
      return undefined;
    bytes.set(packed.subarray(begin, at), filled);
    filled += size;
  }
  return filled === length && at + checksumLength === packed.length && view.getUint32(at) === adler32(bytes)
    ? bytes
    : undefined;
}

function adler32(bytes: Uint8Array): number {
  let [a, b] = [1, 0];
  const run = 2048; // sums of this many bytes stay below 2^31
  for (let begin = 0; begin < bytes.length; begin += run) {
    const end = Math.min(begin + run, bytes.length);
    for (let n = begin; n < end; ++n) {
      a += bytes[n] ?? 0;
      b += a;
    }
    a %= 65521;
    b %= 65521;
  }
  return b * 65536 + a;
}

/**
 * Undoes the five filters of PNG, row by row. A byte is stored relative to the bytes to the left, above, and above to
 * the left.
 */
function unfiltered(
  filtered: Uint8Array,
  rows: number,
  rowLength: number,
  texelLength: number,
): Uint8Array<ArrayBuffer> {
  const bytes = new Uint8Array(rows * rowLength);
  for (let row = 0; row < rows; ++row) {
    const from = row * (rowLength + 1) + 1;
    const source = filtered.subarray(from, from + rowLength);
    const start = row * rowLength;
    const line = bytes.subarray(start, start + rowLength);
    const above = row === 0 ? new Uint8Array(rowLength) : bytes.subarray(start - rowLength, start);
    unfilterRow(filtered[from - 1] ?? 0, source, line, above, texelLength);
  }
  return bytes;
}

function unfilterRow(
  filter: number,
  source: Uint8Array,
  line: Uint8Array,
  above: Uint8Array,
  texelLength: number,
): void {
  // Bytes to the left of the first texel count as 0. Typed arrays wrap at 256, as PNG requires.
  const at = (bytes: Uint8Array, n: number) => (n < 0 ? 0 : (bytes[n] ?? 0));
  const length = source.length;
  switch (filter) {
    case 0:
      line.set(source);
      return;
    case 1:
      for (let n = 0; n < length; ++n) line[n] = at(source, n) + at(line, n - texelLength);
      return;
    case 2:
      for (let n = 0; n < length; ++n) line[n] = at(source, n) + at(above, n);
      return;
    case 3:
      for (let n = 0; n < length; ++n) line[n] = at(source, n) + ((at(line, n - texelLength) + at(above, n)) >> 1);
      return;
    case 4:
      for (let n = 0; n < length; ++n) {
        line[n] = at(source, n) + paeth(at(line, n - texelLength), at(above, n), at(above, n - texelLength));
      }
      return;
    default:
      throw new DecodeError("malformed", `has a row with filter ${filter}`);
  }
}

/** The Paeth predictor (PNG specification, section 9.4). */
function paeth(left: number, above: number, corner: number): number {
  const guess = left + above - corner;
  const toLeft = Math.abs(guess - left);
  const toAbove = Math.abs(guess - above);
  const toCorner = Math.abs(guess - corner);
  if (toLeft <= toAbove && toLeft <= toCorner) return left;
  return toAbove <= toCorner ? above : corner;
}

function isPaletteLength(length: number): boolean {
  return length > 0 && length <= 3 * 256 && length % 3 === 0;
}

/** The colour of each palette index. Throws DecodeError. */
function paletteColorsOf(indices: Uint8Array, palette: Uint8Array): Uint8Array<ArrayBuffer> {
  const colors = new Uint8Array(indices.length * 3);
  for (let n = 0; n < indices.length; ++n) {
    const entry = (indices[n] ?? 0) * 3;
    if (entry + 3 > palette.length) throw new DecodeError("malformed", "names a colour that its palette does not have");
    colors[3 * n] = palette[entry] ?? 0;
    colors[3 * n + 1] = palette[entry + 1] ?? 0;
    colors[3 * n + 2] = palette[entry + 2] ?? 0;
  }
  return colors;
}
