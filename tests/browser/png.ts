// A minimal PNG reader and writer, independent of the product's readers, for screenshots and for the container images
// from which reference pictures are drawn: 8 bits a channel, palettes expanded to RGB, no interlacing. It does not
// validate, because it reads only files of Chromium and of imgeo.

import { crc32, deflateSync, inflateSync } from "node:zlib";

/** Rows from the top, `channels` bytes a pixel: 1 grey, 2 grey and alpha, 3 RGB, 4 RGBA. */
export interface Picture {
  width: number;
  height: number;
  channels: number;
  data: Uint8Array;
}

const channelsOfColorType: Record<number, number> = { 0: 1, 2: 3, 3: 1, 4: 2, 6: 4 };
const colorTypeOfChannels = [0, 0, 4, 2, 6];

export function decodePng(bytes: Uint8Array): Picture {
  const view = Buffer.from(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const width = view.readUInt32BE(16);
  const height = view.readUInt32BE(20);
  const channels = channelsOfColorType[view.readUInt8(25)];
  if (channels === undefined || view.readUInt8(24) !== 8)
    throw new Error("the test decoder reads 8-bit grey and RGB only");
  const [palette] = chunksOf(view, "PLTE");
  const filtered = inflateSync(Buffer.concat(chunksOf(view, "IDAT")));
  const stride = width * channels;
  const data = new Uint8Array(height * stride);
  for (let y = 0; y < height; ++y) {
    const filter = filtered[y * (stride + 1)];
    for (let x = 0; x < stride; ++x) {
      const left = x < channels ? 0 : data[y * stride + x - channels]!;
      const up = y === 0 ? 0 : data[(y - 1) * stride + x]!;
      const corner = y === 0 || x < channels ? 0 : data[(y - 1) * stride + x - channels]!;
      const guess =
        filter === 1
          ? left
          : filter === 2
            ? up
            : filter === 3
              ? (left + up) >> 1
              : filter === 4
                ? paeth(left, up, corner)
                : 0;
      data[y * stride + x] = filtered[y * (stride + 1) + 1 + x]! + guess;
    }
  }
  if (palette === undefined || view.readUInt8(25) !== 3) return { width, height, channels, data };
  return {
    width,
    height,
    channels: 3,
    data: Uint8Array.from({ length: 3 * data.length }, (_, i) => palette[3 * data[Math.floor(i / 3)]! + (i % 3)]!),
  };
}

/** Contents of the chunks of a type. */
function chunksOf(png: Buffer, type: string): Buffer[] {
  const bodies: Buffer[] = [];
  for (let at = 8; at < png.length; at += 12 + png.readUInt32BE(at)) {
    if (png.toString("latin1", at + 4, at + 8) === type)
      bodies.push(png.subarray(at + 8, at + 8 + png.readUInt32BE(at)));
  }
  return bodies;
}

function paeth(left: number, up: number, corner: number): number {
  const toLeft = Math.abs(up - corner);
  const toUp = Math.abs(left - corner);
  const toCorner = Math.abs(left + up - 2 * corner);
  return toLeft <= toUp && toLeft <= toCorner ? left : toUp <= toCorner ? up : corner;
}

/** IHDR, one IDAT of unfiltered rows, IEND. */
export function encodePng({ width, height, channels, data }: Picture): Buffer {
  const header = Buffer.alloc(13);
  header.writeUInt32BE(width, 0);
  header.writeUInt32BE(height, 4);
  header.set([8, colorTypeOfChannels[channels]!], 8);
  const rows = Buffer.alloc(height * (width * channels + 1));
  for (let y = 0; y < height; ++y) {
    rows.set(data.subarray(y * width * channels, (y + 1) * width * channels), y * (width * channels + 1) + 1);
  }
  const signature = Buffer.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]);
  return Buffer.concat([
    signature,
    chunk("IHDR", header),
    chunk("IDAT", deflateSync(rows)),
    chunk("IEND", Buffer.alloc(0)),
  ]);
}

function chunk(type: string, body: Buffer): Buffer {
  const out = Buffer.alloc(12 + body.length);
  out.writeUInt32BE(body.length, 0);
  out.write(type, 4, "latin1");
  out.set(body, 8);
  out.writeUInt32BE(crc32(out.subarray(4, 8 + body.length)), 8 + body.length);
  return out;
}
