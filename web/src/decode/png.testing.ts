// Writes PNG files for tests, independently of the code under test.

import { crc32, deflateSync } from "node:zlib";

export interface TestPng {
  readonly width: number;
  readonly height: number;
  readonly bitDepth?: number;
  readonly colorType?: number;
  readonly interlace?: number;
  /** Chunks between the header and the data. */
  readonly extra?: readonly Uint8Array<ArrayBuffer>[];
}

const signature = [0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a];
const channels: Readonly<Record<number, number>> = { 0: 1, 2: 3, 3: 1, 4: 2, 6: 4 };

export function chunkOf(type: string, data: Uint8Array): Uint8Array<ArrayBuffer> {
  const chunk = Buffer.alloc(data.length + 12);
  chunk.writeUInt32BE(data.length, 0);
  chunk.write(type, 4, "latin1");
  chunk.set(data, 8);
  chunk.writeUInt32BE(crc32(chunk.subarray(4, data.length + 8)), data.length + 8);
  return new Uint8Array(chunk);
}

/** A PNG of zeros. */
export function pngOf({
  width,
  height,
  bitDepth = 8,
  colorType = 2,
  interlace = 0,
  extra = [],
}: TestPng): Uint8Array<ArrayBuffer> {
  const header = Buffer.alloc(13);
  header.writeUInt32BE(width, 0);
  header.writeUInt32BE(height, 4);
  header.set([bitDepth, colorType, 0, 0, interlace], 8);
  const rowLength = 1 + Math.ceil((width * (channels[colorType] ?? 3) * bitDepth) / 8);
  const isHuge = width * height > 2 ** 22;
  return joined([
    Uint8Array.from(signature),
    chunkOf("IHDR", header),
    ...extra,
    chunkOf("IDAT", deflateSync(new Uint8Array(isHuge ? 16 : rowLength * height))),
    chunkOf("IEND", new Uint8Array()),
  ]);
}

export function joined(chunks: readonly Uint8Array[]): Uint8Array<ArrayBuffer> {
  return new Uint8Array(Buffer.concat(chunks));
}

/** A PNG with the values that `byteOf` returns for each texel and channel. */
export function pngWithTexels(
  width: number,
  height: number,
  channels: 1 | 3 | 4,
  byteOf: (texel: number, channel: number) => number,
): Uint8Array<ArrayBuffer> {
  const header = Buffer.alloc(13);
  header.writeUInt32BE(width, 0);
  header.writeUInt32BE(height, 4);
  header.set([8, { 1: 0, 3: 2, 4: 6 }[channels], 0, 0, 0], 8);
  const rows = Buffer.alloc(height * (1 + width * channels));
  for (let texel = 0; texel < width * height; ++texel) {
    for (let channel = 0; channel < channels; ++channel) {
      rows[Math.floor(texel / width) + 1 + texel * channels + channel] = byteOf(texel, channel);
    }
  }
  return joined([
    Uint8Array.from(signature),
    chunkOf("IHDR", header),
    chunkOf("IDAT", deflateSync(rows)),
    chunkOf("IEND", new Uint8Array()),
  ]);
}
