// Reads typed arrays from the files of BG. Counts and offsets come from the document, so they are checked against the
// bytes before any view is made.

import type { Bounds, ElementArray, IndexArray, VertexArray } from "../../stage/vertexArray.ts";
import type { ElementType } from "../../stage/elementType.ts";
import { arrayTypeOf, byteSizeOf } from "../../stage/elementType.ts";
import { DecodeError } from "../decodeError.ts";

/** The range of an attribute in a file. A group is the elements of one vertex. */
export interface ElementRange {
  readonly type: ElementType;
  readonly byteOffset: number;
  /** Bytes from one group to the next; 0: tightly packed. */
  readonly byteStride: number;
  readonly components: 1 | 2 | 3 | 4;
  /** Number of groups; 0: as many as the bytes hold. */
  readonly count: number;
}

/** Number of groups of `range` in a file of `byteLength` bytes. */
export function countThatFits(byteLength: number, range: ElementRange): number {
  const { group, stride } = sizesOf(range);
  const available = byteLength - range.byteOffset;
  return available < group ? 0 : Math.floor((available - group) / stride) + 1;
}

/**
 * The attribute as an array of its elements, in whole groups of its stride. Attributes of one type that are interleaved
 * in one file become views of the same bytes. 32-bit integers become floats, with which shaders compute. Throws
 * DecodeError where the bytes end too early. Safe for untrusted bytes.
 */
export function vertexArrayOf(bytes: Uint8Array<ArrayBuffer>, range: ElementRange): VertexArray {
  const { size, group, stride } = sizesOf(range);
  const offsetInRecord = range.byteOffset % stride;
  const isInterleaved = offsetInRecord > 0 && offsetInRecord % size === 0 && offsetInRecord + group <= stride;
  const byteOffset = isInterleaved ? offsetInRecord : 0; // from the beginning of the view
  const stored = wholeGroups(arrayOf(bytes, range, byteOffset), stride / size);
  return {
    array: stored instanceof Int32Array || stored instanceof Uint32Array ? new Float32Array(stored) : stored,
    components: range.components,
    stride: stride / size,
    offset: byteOffset / size,
  };
}

/** The bounds of the first three components of all groups, without NaN; undefined where they are not finite. */
export function boundsOf({ array, stride, offset }: VertexArray): Bounds | undefined {
  const min: [number, number, number] = [Infinity, Infinity, Infinity];
  const max: [number, number, number] = [-Infinity, -Infinity, -Infinity];
  for (let at = offset; at + 2 < array.length; at += stride) {
    for (let axis = 0; axis < 3; ++axis) {
      const value = array[at + axis] ?? NaN;
      if (value < (min[axis] ?? 0)) min[axis] = value;
      if (value > (max[axis] ?? 0)) max[axis] = value;
    }
  }
  return min.every((value, axis) => value <= (max[axis] ?? NaN) && Number.isFinite(value) && Number.isFinite(max[axis]))
    ? { min, max }
    : undefined;
}

/** Completes the last group, whose padding may be missing in the file. */
function wholeGroups(array: ElementArray, stride: number): ElementArray {
  const length = Math.ceil(array.length / stride) * stride;
  if (array.length === length) return array;
  const whole = new (array.constructor as new (length: number) => ElementArray)(length);
  whole.set(array);
  return whole;
}

/** Reads indices, each below `vertexCount`. Throws DecodeError. Safe for untrusted bytes. */
export function indexArrayOf(bytes: Uint8Array<ArrayBuffer>, range: ElementRange, vertexCount: number): IndexArray {
  const indices = arrayOf(bytes, range);
  if (!(indices instanceof Uint8Array || indices instanceof Uint16Array || indices instanceof Uint32Array)) {
    throw new DecodeError("unsupported", `holds indices as ${range.type}; unsigned integers are needed`);
  }
  let maxIndex = -1;
  for (const index of indices) if (index > maxIndex) maxIndex = index;
  if (maxIndex >= vertexCount)
    throw new DecodeError("malformed", `holds index ${maxIndex} where there are ${vertexCount} vertices`);
  return indices;
}

function sizesOf(range: ElementRange): { size: number; group: number; stride: number } {
  const size = byteSizeOf(range.type);
  const group = size * range.components;
  return { size, group, stride: range.byteStride === 0 ? group : range.byteStride };
}

/** The elements from `bytesBefore` bytes before the range to the end of its last group, including padding. */
function arrayOf(bytes: Uint8Array<ArrayBuffer>, range: ElementRange, bytesBefore = 0): ElementArray {
  const { size, group, stride } = sizesOf(range);
  if (stride % size !== 0 || stride < group) {
    throw new DecodeError("malformed", `has a stride of ${stride} bytes for ${range.components} ${range.type}`);
  }
  const maxCount = countThatFits(bytes.byteLength, range);
  const count = range.count === 0 ? maxCount : range.count;
  if (count > maxCount)
    throw new DecodeError(
      "truncated",
      `holds ${maxCount} of ${count} ${range.components === 1 ? "indices" : "vertices"}`,
    );
  if (count === 0) return new (arrayTypeOf(range.type))(0);
  // The padding of the last group is included where the file has it.
  const begin = range.byteOffset - bytesBefore;
  const byteLength = Math.min(count * stride, Math.floor((bytes.byteLength - begin) / size) * size);
  const byteOffset = bytes.byteOffset + begin;
  // A view must begin at a multiple of the element size; otherwise the bytes are copied.
  return byteOffset % size === 0
    ? new (arrayTypeOf(range.type))(bytes.buffer, byteOffset, byteLength / size)
    : new (arrayTypeOf(range.type))(bytes.buffer.slice(byteOffset, byteOffset + byteLength));
}
