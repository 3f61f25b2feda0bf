// Decodes a PNG with alpha to texels of a texture, in JavaScript, for browsers whose ImageBitmap loses the colours of
// transparent texels (PNG specification, third edition, W3C 2025).

import { DecodeError } from "./decodeError.ts";
import { checkChunks } from "./png.ts";
import { chunksOf, unpackedRows } from "./pngPixels.ts";

/** RGBA of 8 bits each, not multiplied by alpha; the lowest row first, as in texture coordinates. */
export interface Texels {
  readonly width: number;
  readonly height: number;
  readonly data: Uint8Array<ArrayBuffer>;
}

export interface TexelsJob {
  readonly bytes: Uint8Array<ArrayBuffer>;
  /** Texels are data, not colours, so that no colour conversion applies. */
  readonly isData: boolean;
  /** Maximum width and height. */
  readonly maxEdge: number;
}

const headerOffset = 16;
const [palette, grayWithAlpha] = [3, 4];
/** Samples of a texel by colour type. */
const samplesOfType: Readonly<Record<number, number>> = { 0: 1, 2: 3, [palette]: 1, [grayWithAlpha]: 2, 6: 4 };

/**
 * Undefined where decoding needs a browser: for colours in another space than sRGB, an animation, an orientation, 16
 * bits, interlaced rows, edges longer than `maxEdge`, and for damaged files. Safe for untrusted bytes.
 */
export async function pngTexels({ bytes, isData, maxEdge }: TexelsJob): Promise<Texels | undefined> {
  try {
    const types = checkChunks(bytes);
    const hasColorSpace = types.includes("cICP") || (types.some(isColorSpace) && !types.includes("sRGB"));
    if (types.some(changesPicture) || (hasColorSpace && !isData)) return undefined;
    return await decoded(bytes, maxEdge);
  } catch (error) {
    if (error instanceof DecodeError) return undefined;
    throw error;
  }
}

const isColorSpace = (type: string): boolean => /^(iCCP|gAMA|cHRM)$/.test(type);
const changesPicture = (type: string): boolean => /^(acTL|eXIf)$/.test(type);

async function decoded(bytes: Uint8Array<ArrayBuffer>, maxEdge: number): Promise<Texels | undefined> {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const [width, height] = [view.getUint32(headerOffset), view.getUint32(headerOffset + 4)];
  const [depth = 0, type = NaN, ...methods] = bytes.subarray(headerOffset + 8, headerOffset + 13);
  const samples = samplesOfType[type];
  const isDepth = depth === 8 || ((depth === 1 || depth === 2 || depth === 4) && (type === 0 || type === palette));
  if (samples === undefined || !isDepth || methods.some((method) => method !== 0)) return undefined;
  if (Math.min(width, height) < 1 || Math.max(width, height) > maxEdge) return undefined;
  const chunks = chunksOf(bytes);
  const rowLength = Math.ceil((width * samples * depth) / 8);
  const rows = await unpackedRows(chunks, { rows: height, rowLength, texelLength: Math.ceil((samples * depth) / 8) });
  const chunk = (name: string) => chunks.find((chunk) => chunk.type === name)?.data ?? new Uint8Array();
  const write = rowWriterOf(type, depth, chunk("PLTE"), chunk("tRNS"));
  const data = new Uint8Array(width * height * 4);
  for (let row = 0; row < height; ++row) {
    const start = (height - 1 - row) * width * 4;
    write(rows.subarray(row * rowLength, (row + 1) * rowLength), data.subarray(start, start + width * 4));
  }
  return { width, height, data };
}

type WriteRow = (source: Uint8Array, texels: Uint8Array) => void;

function rowWriterOf(type: number, depth: number, colors: Uint8Array, transparency: Uint8Array): WriteRow {
  switch (type) {
    case 0:
    case palette:
      return indexedRow(depth, type === palette ? paletteOf(colors, transparency) : graysOf(depth, transparency));
    case 2:
      return (source, texels) => {
        // The colour that counts as transparent, 16 bits a sample.
        const [r = -1, g = -1, b = -1] = [transparency[1], transparency[3], transparency[5]];
        for (let from = 0, to = 0; to < texels.length; from += 3, to += 4) {
          texels.set(source.subarray(from, from + 3), to);
          const isTransparent = source[from] === r && source[from + 1] === g && source[from + 2] === b;
          texels[to + 3] = isTransparent ? 0 : 255;
        }
      };
    case grayWithAlpha:
      return (source, texels) => {
        for (let from = 0, to = 0; to < texels.length; from += 2, to += 4) {
          texels.fill(source[from] ?? 0, to, to + 3);
          texels[to + 3] = source[from + 1] ?? 0;
        }
      };
    default:
      return (source, texels) => {
        texels.set(source);
      };
  }
}

/** Looks up numbers of `depth` bits in a table of RGBA. */
function indexedRow(depth: number, table: Uint8Array): WriteRow {
  const perByte = 8 / depth;
  const mask = 2 ** depth - 1;
  return (source, texels) => {
    for (let n = 0; 4 * n < texels.length; ++n) {
      const shift = 8 - depth * (1 + (n % perByte));
      const entry = 4 * (((source[Math.floor(n / perByte)] ?? 0) >> shift) & mask);
      if (entry >= table.length) throw new DecodeError("malformed", "names a colour that its palette does not have");
      texels.set(table.subarray(entry, entry + 4), 4 * n);
    }
  };
}

function paletteOf(colors: Uint8Array, alphas: Uint8Array): Uint8Array {
  return Uint8Array.from({ length: 4 * Math.floor(colors.length / 3) }, (_, n) =>
    n % 4 === 3 ? (alphas[n >> 2] ?? 255) : (colors[3 * (n >> 2) + (n % 4)] ?? 0),
  );
}

/** All grays of a bit depth. `transparent`: the one that counts as transparent, 16 bits, if any. */
function graysOf(depth: number, transparent: Uint8Array): Uint8Array {
  const max = 2 ** depth - 1;
  return Uint8Array.from({ length: 4 * (max + 1) }, (_, n) =>
    n % 4 < 3 ? ((n >> 2) * 255) / max : n >> 2 === transparent[1] ? 0 : 255,
  );
}
