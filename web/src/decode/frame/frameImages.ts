// Decodes a frame of a live stream to the texels that shaders read vertices from, as those of SIG classic. Runs in
// workers.

import { DecodeError } from "../decodeError.ts";
import type { Frame } from "./frame.ts";
import { decodeFrame } from "./frame.ts";
import type { ComponentRun, FrameHeader, FrameLayout } from "./frameHeader.ts";
import { componentRunsOf } from "./frameHeader.ts";
import { normalWords } from "./normalWords.ts";

/** Texels of four bytes, row by row. Vertex n is texel n; texels behind the last vertex are 0. */
export type Texels = Uint8Array<ArrayBuffer>;

export interface FrameImages {
  readonly header: FrameHeader;
  /** Size of all images, in texels. */
  readonly width: number;
  readonly height: number;
  /** x, y, z in red, green, blue: an image for each byte, most significant first. */
  readonly coord: readonly Texels[];
  /** Octahedral numbers of 16 bits: high bytes in red and green, low bytes in blue and alpha. */
  readonly normal: Texels | undefined;
  readonly color: Texels | undefined;
  /** Component c in channel c: an image for each byte, most significant first. */
  readonly value: readonly Texels[];
}

/** The longest edge of a texture that every GPU has. */
const maxEdge = 4096;

/** Size of the images of a frame: a row for each of the grid's. */
export function frameImageSizeOf({ vertices, columns }: FrameLayout): { width: number; height: number } {
  const width = columns > 0 ? columns : Math.min(vertices, 1024);
  return { width, height: Math.ceil(vertices / width) };
}

/** Rejects with DecodeError. */
export async function frameImages(bytes: Uint8Array<ArrayBuffer>): Promise<FrameImages> {
  return imagesOfFrame(await decodeFrame(bytes));
}

/** Throws DecodeError for a frame that is too large for images. */
export function imagesOfFrame({ header, components }: Frame): FrameImages {
  const { width, height } = frameImageSizeOf(header);
  if (width > maxEdge || height > maxEdge)
    throw new DecodeError("limit", `has a grid of ${width} x ${height} vertices; ${maxEdge} x ${maxEdge} are drawn`);
  const texelBytes = 4 * width * height;
  const images: Record<ComponentRun["attribute"], Texels[]> = { position: [], normal: [], color: [], value: [] };
  let first = 0;
  for (const { attribute, count, bits } of componentRunsOf(header)) {
    const run = components.slice(first, first + count);
    first += count;
    images[attribute] = attribute === "normal" ? [pairTexels(run, bits, texelBytes)] : planes(run, bits, texelBytes);
  }
  const { position: coord, normal, color, value } = images;
  return { header, width, height, coord, normal: normal[0], color: color[0], value };
}

function planes(components: readonly Uint32Array[], bits: number, texelBytes: number): Texels[] {
  const byteCount = Math.ceil(bits / 8);
  return Array.from({ length: byteCount }, (_, plane) => {
    const texels = new Uint8Array(texelBytes);
    const shift = 8 * (byteCount - 1 - plane);
    components.forEach((values, channel) => {
      for (let vertex = 0; vertex < values.length; ++vertex)
        texels[4 * vertex + channel] = (values[vertex] ?? 0) >>> shift;
    });
    return texels;
  });
}

function pairTexels(components: readonly Uint32Array[], bits: number, texelBytes: number): Texels {
  const texels = new Uint8Array(texelBytes);
  components.forEach((values, channel) => {
    const words = normalWords(values, bits);
    for (let vertex = 0; vertex < words.length; ++vertex) {
      const word = words[vertex] ?? 0;
      texels[4 * vertex + channel] = word >>> 8;
      texels[4 * vertex + 2 + channel] = word;
    }
  });
  return texels;
}
