// Writes vectors/png: PNG files that the decoders of both languages must read or refuse alike. Run `scripts/node
// tests/generators/pngVectors.ts` after adding a row to `files`; the other files do not change. What each reader must
// return is in vectors/png/verdicts.json, which is written by hand.
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { crc32, deflateSync, inflateSync } from "node:zlib";

const signature = Buffer.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]);

/** The PNG colour types (PNG specification, section 11.2.2). */
const [gray, rgb, palette, grayWithAlpha, rgba] = [0, 2, 3, 4, 6];
const channelsOf: Readonly<Record<number, number>> = { [gray]: 1, [rgb]: 3, [rgba]: 4 };

/** Pseudorandom bytes, which deflate cannot compress. */
const noise = (first: number, length: number): Buffer =>
  Buffer.from(Array.from({ length }, (_, n) => ((first + n) * 2654435761) >>> 23));

/** A chunk; `checksum` replaces the valid one. */
function chunk(type: string, data: Uint8Array = Buffer.alloc(0), checksum?: number): Buffer {
  const bytes = Buffer.alloc(data.length + 12);
  bytes.writeUInt32BE(data.length);
  bytes.write(type, 4, "latin1");
  bytes.set(data, 8);
  bytes.writeUInt32BE(checksum ?? crc32(bytes.subarray(4, data.length + 8)), data.length + 8);
  return bytes;
}

/** The data of a header. `methods`: compression, filter and interlace method. */
function headerData(width: number, height: number, colorType: number, bitDepth = 8, methods = [0, 0, 0]): Buffer {
  const data = Buffer.alloc(13);
  data.writeUInt32BE(width);
  data.writeUInt32BE(height, 4);
  data.set([bitDepth, colorType, ...methods], 8);
  return data;
}

/** Texels with a filter type before each row, and filtered by it (PNG specification, section 9). */
function filtered(
  texels: Uint8Array,
  rowLength: number,
  channels: number,
  filterOf: (row: number) => number = () => 0,
): Buffer {
  const rows: number[] = [];
  for (let row = 0; row * rowLength < texels.length; ++row) {
    const byte = (r: number, n: number) => (r < 0 || n < 0 ? 0 : (texels[r * rowLength + n] ?? 0));
    rows.push(filterOf(row));
    for (let n = 0; n < rowLength; ++n) {
      const [left, above, corner] = [byte(row, n - channels), byte(row - 1, n), byte(row - 1, n - channels)];
      const p = left + above - corner;
      const paeth = [left, above, corner].reduce((a, b) => (Math.abs(p - b) < Math.abs(p - a) ? b : a));
      rows.push(byte(row, n) - ([0, left, above, (left + above) >> 1, paeth][filterOf(row)] ?? 0));
    }
  }
  return Buffer.from(rows);
}

const deflatedBest = (rows: Buffer): Buffer => deflateSync(rows, { level: 9 });
const deflated = (rows: Buffer): Buffer => deflateSync(rows);
const storedBlocks = (rows: Buffer): Buffer => deflateSync(rows, { level: 0 });

/** The bytes with the lowest bit of one of them changed. */
function withDamage(bytes: Buffer, byteOffset: number): Buffer {
  const changed = Buffer.from(bytes);
  changed[byteOffset] = (changed[byteOffset] ?? 0) ^ 1;
  return changed;
}

const png = (...chunks: readonly Buffer[]): Buffer => Buffer.concat([signature, ...chunks, chunk("IEND")]);

/** The filter types of ten rows: every type occurs twice. */
const allFilters = (row: number): number => [0, 1, 2, 3, 4, 4, 3, 2, 1, 0][row] ?? 0;

/** Streams of filtered rows in base 64, by file: they come from another compressor than Node's. */
const foreignStreams: Readonly<Record<string, string>> = {
  "filters-gray":
    "eNpjmHFV0K/rGLN9DeMOWxsbWxBkUoAB5p51+nr6QKzHomAD5NvIKyiwIGRt9IAyIAVAHfIQMcbpthBDbBi2fzHIXflMKW42AJJb" + "F9w=",
  "filters-rgb":
    "eNpjmHFV0K/rGLN9zY6vhrmrninHz7khGth7is25fg/jD5PCrduAEAiQKDCDKQEI4oEQlQIzmLtXneDm7u7u4u7q7ubu7urm6gbS" +
    "XEA+VzcLUH7r1njRrdsSREW3gnB8gug2IAMoyALSDhKFSG/dCpKJFxXdBhRlnr3rOtw4bohx3VA7mJAtR6MYp13iR3M6nGL4ZpS3" +
    "+rlKwtybokF9p9ldGvb+NC1a91o9ZcEdSQBiQX+G",
  "filters-rgba":
    "eNpjmHFV0K/rGLN9zY6vhrmrninHz7khGth7is25fs8Pk8K1r9SS599mlAiZePbTp49ACAZQBirFVN8AgkAAZWCjmM+86li2c4el" +
    "5U4gYbFzp6Xljp0WQA6QvWOnJZTBAlIPMrUe3Y4GBJ8FZByE24DusgaYKubulSeeguzYATQazTK4C4hyOOPUS3xe2LyNbDWDaGAf" +
    "JORMISF3BxRwXG7N+/9YlGx8q5W2+L50BAC5wOxK",
  "filters-palette": "eNpjYWBk/AdEzBCKkQlCMTJCxRkYmcAIALvCCBQ=",
  "filters-in-first-row": "eNpj0ctavhUItgEhKrVtKwD03xJD",
};

/** The stream of a file, which must inflate to these rows. */
function foreignStream(name: string, rows: Buffer): Buffer {
  const stream = Buffer.from(foreignStreams[name] ?? "", "base64");
  if (!inflateSync(stream).equals(rows)) throw new Error(`the stream of ${name} holds other rows`);
  return stream;
}

// Most files are variations of three images of 7 x 5 texels.
const [width, height] = [7, 5];
const grayRows = filtered(noise(1, width * height), width, 1);
const rgbRows = filtered(noise(1, width * height * 3), width * 3, 3);
const rgbaRows = filtered(noise(1, width * height * 4), width * 4, 4);
const indices = Buffer.from(Array.from({ length: width * height }, (_, n) => n % 3));
const [grayHeader, rgbHeader, rgbaHeader, paletteHeader] = [gray, rgb, rgba, palette].map((colorType) =>
  chunk("IHDR", headerData(width, height, colorType)),
) as [Buffer, Buffer, Buffer, Buffer];
const colors = chunk("PLTE", noise(3, 9));
const grayData = chunk("IDAT", deflatedBest(grayRows));
const rgbStream = deflatedBest(rgbRows);
const rgbData = chunk("IDAT", rgbStream);
const paletteData = chunk("IDAT", deflatedBest(filtered(indices, width, 1)));
const rgbPng = png(rgbHeader, rgbData);
const textChunk = chunk("tEXt", Buffer.from("a\0b"));

/** The RGB image with another header. */
const withHeader = (...header: Parameters<typeof headerData>): Buffer =>
  png(chunk("IHDR", headerData(...header)), chunk("IDAT", deflated(rgbRows)));
/** The RGB image with other bytes in its image data. */
const withData = (stream: Buffer): Buffer => png(rgbHeader, chunk("IDAT", stream));
const withPalette = (entries: Buffer, data = paletteData): Buffer => png(paletteHeader, chunk("PLTE", entries), data);
/** An image of 9 x 10 texels with every filter. */
function withFilters(name: string, colorType: number): Buffer {
  const channels = channelsOf[colorType] ?? 0;
  const rows = filtered(noise(11, 9 * 10 * channels), 9 * channels, channels, allFilters);
  return png(chunk("IHDR", headerData(9, 10, colorType)), chunk("IDAT", foreignStream(name, rows)));
}

/** The files by name: first those that readers accept. */
const files: Readonly<Record<string, Buffer>> = {
  gray: png(grayHeader, grayData),
  rgb: rgbPng,
  rgba: png(rgbaHeader, chunk("IDAT", deflatedBest(rgbaRows))),
  palette: png(paletteHeader, colors, paletteData),
  "palette-of-256": withPalette(
    noise(7, 768),
    chunk("IDAT", deflatedBest(filtered(noise(9, width * height), width, 1))),
  ),
  "filters-gray": withFilters("filters-gray", gray),
  "filters-rgb": withFilters("filters-rgb", rgb),
  "filters-rgba": withFilters("filters-rgba", rgba),
  "filters-palette": png(
    paletteHeader,
    colors,
    chunk(
      "IDAT",
      foreignStream(
        "filters-palette",
        filtered(indices, width, 1, (row) => 4 - row),
      ),
    ),
  ),
  "filters-in-first-row": png(
    chunk("IHDR", headerData(9, 1, rgb)),
    chunk(
      "IDAT",
      foreignStream(
        "filters-in-first-row",
        filtered(noise(5, 27), 27, 3, () => 4),
      ),
    ),
  ),
  "several-idat": png(
    rgbHeader,
    ...[0, 31, 62, 93].map((begin) => chunk("IDAT", rgbStream.subarray(begin, begin + 31))),
  ),
  "empty-idat": png(grayHeader, chunk("IDAT"), chunk("IDAT", deflated(grayRows))),
  "stored-blocks": withData(storedBlocks(rgbRows)),
  "stored-blocks-several": png(
    chunk("IHDR", headerData(300, 300, gray)),
    chunk("IDAT", storedBlocks(filtered(noise(13, 300 * 300), 300, 1))),
  ),
  "ancillary-chunks": png(
    rgbHeader,
    chunk("gAMA", Buffer.from([0, 1, 0x86, 0xa0])),
    chunk("tEXt", Buffer.from("Comment\0x")),
    rgbData,
  ),
  "palette-suggested-for-rgb": png(rgbHeader, colors, rgbData),
  "one-texel": png(chunk("IHDR", headerData(1, 1, gray)), chunk("IDAT", deflatedBest(Buffer.from([0, 127])))),
  "longest-edge": png(
    chunk("IHDR", headerData(4096, 1, gray)),
    chunk("IDAT", deflatedBest(filtered(noise(17, 4096), 4096, 1))),
  ),

  // Other bytes, and parts of a PNG.
  empty: Buffer.alloc(0),
  "half-signature": signature.subarray(0, 4),
  "no-signature": Buffer.from("not a PNG at all"),
  jpeg: Buffer.from("\xff\xd8\xff\xe0\0\x10JFIF\0\x01\x01\0\0\x01\0\x01\0\0", "latin1"),
  webp: Buffer.concat([Buffer.from("RIFF \0\0\0WEBPVP8L"), Buffer.alloc(24)]),
  gif: Buffer.from("GIF89a\x01\0\x01\0\0\0\0;"),
  "signature-only": signature,
  "ends-in-header": rgbPng.subarray(0, 20),
  "ends-in-data": rgbPng.subarray(0, 60),
  "no-end": rgbPng.subarray(0, -12),
  "bytes-after-end": Buffer.concat([rgbPng, Buffer.alloc(1)]),

  // Headers of images that cannot hold vertex data, or that are invalid.
  "sixteen-bits": withHeader(width, height, rgb, 16),
  "one-bit-gray": withHeader(width, height, gray, 1),
  "gray-with-alpha": withHeader(width, height, grayWithAlpha),
  "unknown-colour-type": withHeader(width, height, 5),
  "four-bit-palette": png(
    chunk("IHDR", headerData(width, height, palette, 4)),
    colors,
    chunk("IDAT", deflated(Buffer.alloc(5 * height))),
  ),
  interlaced: withHeader(width, height, rgb, 8, [0, 0, 1]),
  "unknown-compression": withHeader(width, height, rgb, 8, [1, 0, 0]),
  "unknown-filter-method": withHeader(width, height, rgb, 8, [0, 1, 0]),
  "transparent-palette": png(paletteHeader, colors, chunk("tRNS", Buffer.from([0])), paletteData),
  "transparent-gray": png(grayHeader, chunk("tRNS", Buffer.from([0, 7])), grayData),
  "transparent-rgb": png(rgbHeader, chunk("tRNS", Buffer.from([0, 7, 0, 7, 0, 7])), rgbData),
  "too-wide": withHeader(4097, height, rgb),
  "too-high": withHeader(width, 4097, rgb),
  "no-width": withHeader(0, height, rgb),
  huge: withHeader(2 ** 31 - 1, 2 ** 31 - 1, rgb),

  // Wrong checksums, and chunks in a wrong order or number.
  "damaged-data": withDamage(rgbPng, 47),
  "damaged-header-sum": withDamage(rgbPng, 29),
  "damaged-palette-sum": png(paletteHeader, chunk("PLTE", noise(3, 9), 1), paletteData),
  "damaged-end-sum": withDamage(rgbPng, rgbPng.length - 1),
  "unknown-critical-chunk": png(rgbHeader, chunk("ABCD", Buffer.from("x")), rgbData),
  "two-palettes": png(paletteHeader, colors, colors, paletteData),
  "data-in-two-runs": png(
    rgbHeader,
    chunk("IDAT", rgbStream.subarray(0, 61)),
    textChunk,
    chunk("IDAT", rgbStream.subarray(61)),
  ),
  "no-data": png(rgbHeader),
  "header-not-first": png(textChunk, rgbHeader, rgbData),
  "two-headers": png(rgbHeader, rgbHeader, rgbData),
  "short-header": png(chunk("IHDR", headerData(width, height, rgb).subarray(0, 12)), rgbData),

  // Palettes that are missing, have a wrong length, or lack a colour that the image names.
  "no-palette": png(paletteHeader, paletteData),
  "palette-of-four-bytes": withPalette(Buffer.from("1234")),
  "empty-palette": withPalette(Buffer.alloc(0)),
  "palette-too-large": withPalette(Buffer.alloc(771, 1)),
  "palette-too-short": withPalette(
    noise(3, 9),
    chunk("IDAT", deflatedBest(filtered(Buffer.alloc(width * height, 3), width, 1))),
  ),

  // Wrong image data in a valid chunk.
  "unknown-filter": withData(deflated(Buffer.concat([Buffer.from([5]), rgbRows.subarray(1)]))),
  "more-than-its-texels": withData(deflated(Buffer.concat([rgbRows, Buffer.alloc(1)]))),
  "less-than-its-texels": withData(deflated(rgbRows.subarray(0, -1))),
  "more-stored-bytes-than-texels": withData(storedBlocks(Buffer.concat([rgbRows, Buffer.alloc(1)]))),
  "fewer-stored-bytes-than-texels": withData(storedBlocks(rgbRows.subarray(0, -1))),
  "wrong-adler": withData(withDamage(deflated(rgbRows), 120)),
  "wrong-adler-of-stored-blocks": withData(withDamage(storedBlocks(rgbRows), 120)),
  "zlib-stream-cut": withData(deflated(rgbRows).subarray(0, -20)),
  "bytes-after-zlib-stream": withData(Buffer.concat([deflated(rgbRows), Buffer.alloc(2)])),
  "no-zlib-stream": withData(Buffer.alloc(40, 0xff)),
  "too-short-for-its-size": withHeader(4096, 4096, rgba),
};

const folder = join(import.meta.dirname, "../../vectors/png");
for (const [name, bytes] of Object.entries(files)) writeFileSync(join(folder, `${name}.png`), bytes);
