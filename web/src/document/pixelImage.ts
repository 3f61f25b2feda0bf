// X3D's SFImage (ISO/IEC 19776-1, 5.9), an image whose pixels are numbers in the document. It becomes a PNG, so that it
// is decoded like other textures.

/** Rows are bottom-up, as in X3D. A pixel's components are its bytes, most significant first. */
export interface PixelImage {
  readonly width: number;
  readonly height: number;
  /** Intensity; intensity and alpha; RGB; RGBA. */
  readonly components: 1 | 2 | 3 | 4;
  readonly pixels: readonly number[];
}

export const noPixels: PixelImage = { width: 0, height: 0, components: 1, pixels: [] };

/** The largest texture size of most GPUs. */
const maxEdge = 16384;

/** Parses the numbers of an SFImage; undefined where they do not match its size or a pixel exceeds its components. */
export function pixelImageOf([width, height, componentCount, ...pixels]: readonly number[]): PixelImage | undefined {
  if (width === undefined || height === undefined) return undefined;
  const isEdge = (edge: number) => Number.isInteger(edge) && edge >= 0 && edge <= maxEdge;
  if (!isEdge(width) || !isEdge(height) || width * height !== pixels.length) return undefined;
  if (width * height === 0) return noPixels; // "0 0 0": none
  const components = ([1, 2, 3, 4] as const).find((possible) => possible === componentCount);
  const end = 256 ** (components ?? 0);
  const isPixel = (pixel: number) => Number.isInteger(pixel) && pixel >= 0 && pixel < end;
  return components && pixels.every(isPixel) ? { width, height, components, pixels } : undefined;
}

const pngColorTypes = { 1: 0, 2: 4, 3: 2, 4: 6 } as const;
const signature = [0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a];

/** Encodes a PNG without compression, since it is decoded once, on the same machine. */
export function pngOfPixels({ width, height, components, pixels }: PixelImage): Uint8Array {
  const header = new Uint8Array(13);
  const numbers = new DataView(header.buffer);
  numbers.setUint32(0, width);
  numbers.setUint32(4, height);
  header.set([8, pngColorTypes[components]], 8);
  const rows = new Uint8Array(height * (1 + width * components)); // each row begins with its filter type, 0 for none
  let offset = 0;
  for (let row = height - 1; row >= 0; --row) {
    ++offset;
    for (let column = 0; column < width; ++column) {
      const pixel = pixels[row * width + column] ?? 0;
      for (let shift = 8 * (components - 1); shift >= 0; shift -= 8) rows[offset++] = pixel >>> shift;
    }
  }
  return concatenate([
    Uint8Array.from(signature),
    chunk("IHDR", header),
    chunk("IDAT", storedZlib(rows)),
    chunk("IEND", new Uint8Array()),
  ]);
}

function chunk(type: string, data: Uint8Array): Uint8Array {
  const bytes = new Uint8Array(data.length + 12);
  const numbers = new DataView(bytes.buffer);
  numbers.setUint32(0, data.length);
  bytes.set(
    Array.from(type, (letter) => letter.charCodeAt(0)),
    4,
  );
  bytes.set(data, 8);
  numbers.setUint32(data.length + 8, crc32(bytes.subarray(4, data.length + 8)));
  return bytes;
}

/** RFC 1950 around RFC 1951's stored blocks. */
function storedZlib(data: Uint8Array): Uint8Array {
  const maxBlockLength = 65535;
  const pieces: Uint8Array[] = [Uint8Array.of(0x78, 0x01)];
  for (let start = 0; start < data.length; start += maxBlockLength) {
    const block = data.subarray(start, start + maxBlockLength);
    const isLast = start + maxBlockLength >= data.length;
    const { length } = block;
    pieces.push(Uint8Array.of(Number(isLast), length & 255, length >> 8, ~length & 255, (~length >> 8) & 255), block);
  }
  const checksum = new Uint8Array(4);
  new DataView(checksum.buffer).setUint32(0, adler32(data));
  return concatenate([...pieces, checksum]);
}

function adler32(bytes: Uint8Array): number {
  let [a, b] = [1, 0];
  for (const byte of bytes) {
    a = (a + byte) % 65521;
    b = (b + a) % 65521;
  }
  return b * 65536 + a;
}

const crcTable = Uint32Array.from({ length: 256 }, (_, byte) => {
  let crc = byte;
  for (let bit = 0; bit < 8; ++bit) crc = crc & 1 ? (crc >>> 1) ^ 0xedb88320 : crc >>> 1;
  return crc;
});

function crc32(bytes: Uint8Array): number {
  let crc = 0xffffffff;
  for (const byte of bytes) crc = (crcTable[(crc ^ byte) & 255] ?? 0) ^ (crc >>> 8);
  return ~crc >>> 0;
}

function concatenate(arrays: readonly Uint8Array[]): Uint8Array {
  const result = new Uint8Array(arrays.reduce((sum, { length }) => sum + length, 0));
  let offset = 0;
  for (const array of arrays) {
    result.set(array, offset);
    offset += array.length;
  }
  return result;
}
