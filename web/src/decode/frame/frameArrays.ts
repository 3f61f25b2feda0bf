// Decodes a frame of a live stream to arrays for buffers: the integers that shaders would read from its images
// (frameImages.ts), and normals where the frame has none. Runs in workers.

import type { ElementArray, IndexArray, VertexArray } from "../../stage/vertexArray.ts";
import type { Grid } from "../../stage/stage.ts";
import { gridNormals, triangleNormals } from "../vertexNormals.ts";
import type { Frame } from "./frame.ts";
import { decodeFrame } from "./frame.ts";
import type { ComponentRun, FrameHeader } from "./frameHeader.ts";
import { componentRunsOf } from "./frameHeader.ts";
import { normalWords } from "./normalWords.ts";

/** What the normals of a frame without stored ones follow from. */
export type NormalSource =
  | {
      readonly kind: "grid";
      readonly grid: Grid;
      /** Whether the front, to which normals point, is counterclockwise. */
      readonly ccw: boolean;
    }
  | {
      readonly kind: "triangles";
      /** Three vertices of each, whose front is counterclockwise; all less than the frame's number of vertices. */
      readonly index: IndexArray;
    };

export interface FrameArraysJob {
  readonly bytes: Uint8Array<ArrayBuffer>;
  /** Undefined: frames without normals get none. */
  readonly normalSource: NormalSource | undefined;
}

export interface FrameArrays {
  readonly header: FrameHeader;
  /** Stored integers, as are the values; those of 17 to 24 bits as Float32. */
  readonly coord: VertexArray;
  /** Octahedral pairs of 16 bits where the frame has normals; else unit vectors. */
  readonly normal: VertexArray | undefined;
  readonly color: VertexArray | undefined;
  readonly value: VertexArray | undefined;
}

/** Rejects with DecodeError. */
export async function frameArrays({ bytes, normalSource }: FrameArraysJob): Promise<FrameArrays> {
  return arraysOfFrame(await decodeFrame(bytes), normalSource);
}

export function arraysOfFrame({ header, components }: Frame, normalSource: NormalSource | undefined): FrameArrays {
  const arrays: Partial<Record<ComponentRun["attribute"], VertexArray>> = {};
  let first = 0;
  for (const { attribute, count, bits } of componentRunsOf(header)) {
    const run = components.slice(first, first + count);
    first += count;
    arrays[attribute] = attribute === "normal" ? pairs(run, bits) : integers(run, bits);
  }
  const { position: coord = integers([], 8), normal, color, value } = arrays;
  return { header, coord, normal: normal ?? derivedNormals(coord, header.vertices, normalSource), color, value };
}

/** Records of whole multiples of four bytes, which WebGL reads faster. */
function integers(components: readonly Uint32Array[], bits: number): VertexArray {
  const count = components.length;
  const stride = bits > 16 ? count : 4;
  const length = stride * (components[0]?.length ?? 0);
  const array: ElementArray =
    bits <= 8 ? new Uint8Array(length) : bits <= 16 ? new Uint16Array(length) : new Float32Array(length);
  components.forEach((values, component) => {
    for (let vertex = 0, at = component; vertex < values.length; ++vertex, at += stride)
      array[at] = values[vertex] ?? 0;
  });
  return { array, components: count as VertexArray["components"], stride, offset: 0 };
}

function pairs(components: readonly Uint32Array[], bits: number): VertexArray {
  const array = new Uint16Array(2 * (components[0]?.length ?? 0));
  components.forEach((values, component) => {
    const words = normalWords(values, bits);
    for (let vertex = 0; vertex < words.length; ++vertex) array[2 * vertex + component] = words[vertex] ?? 0;
  });
  return { array, components: 2, stride: 2, offset: 0 };
}

function derivedNormals(
  coord: VertexArray,
  vertexCount: number,
  source: NormalSource | undefined,
): VertexArray | undefined {
  if (source === undefined) return undefined;
  const array =
    source.kind === "grid"
      ? gridNormals(coord, source.grid, [1, 1, 1], source.ccw ? 1 : -1)
      : triangleNormals(coord, vertexCount, source.index);
  return { array, components: 3, stride: 3, offset: 0 };
}
