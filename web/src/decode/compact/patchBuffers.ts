// Converts a decoded patch to arrays for the GPU: its wedges are the vertices. Attributes keep the smallest type that
// holds their bits; positions stay lattice integers.

import { makeIndex } from "../indexArray.ts";
import type { ByVertexRole } from "../../stage/attributeRows.ts";
import { byVertexRole, withTexCoordRoles } from "../../stage/attributeRows.ts";
import type { ElementArray, IndexArray, VertexArray } from "../../stage/vertexArray.ts";
import type { AttributeKind, AttributeType, Topology } from "./header.ts";
import type { CompactPatch } from "./patch.ts";
import { orderForVertexCache } from "./vertexCache.ts";

export interface PatchBuffers {
  readonly topology: Topology;
  readonly positionBits: number;
  readonly vertexCount: number;
  /** Corners of triangles or lines; undefined for points, which are drawn in order. */
  readonly index: IndexArray | undefined;
  /** Lattice integers; floats where they have more than 16 bits. */
  readonly coord: VertexArray;
  /** Normals: directions of any length, in a signed integer type. The others: normalized unsigned integers. */
  readonly attributes: ByVertexRole<VertexArray>;
  /** Further attributes, in the order of the file. */
  readonly others: readonly OtherValues[];
}

/** Integers 0 … 2^bits - 1. */
export interface OtherValues {
  readonly bits: number;
  readonly vertices: VertexArray;
}

/** The vertices of one attribute of a file. */
export interface AttributeBuffer {
  readonly kind: AttributeKind;
  readonly bits: number;
  readonly vertices: VertexArray;
}

/** The arrays of a patch, whose triangles are put into an order that suits the GPU. */
export function buffersOf(patch: CompactPatch): PatchBuffers {
  return { ...verticesOf(patch), index: patch.header.topology === "points" ? undefined : orderedIndexOf(patch) };
}

/** The arrays of a patch of triangles or lines, which keep their order. */
export function unorderedBuffersOf(patch: CompactPatch): PatchBuffers {
  return { ...verticesOf(patch), index: indexOf(patch.wedges.wedge, patch.header.wedgeCount) };
}

/**
 * Finds the roles of a patch's attributes: the first normals and colours, and the n-th texture coordinates as those of
 * set n.
 */
export function withRoles(attributes: readonly AttributeBuffer[]): Pick<PatchBuffers, "attributes" | "others"> {
  const verticesOfKind = (of: AttributeKind) =>
    attributes.flatMap(({ kind, vertices }) => (kind === of ? [vertices] : []));
  const byRole: ByVertexRole<VertexArray> = {
    normal: verticesOfKind("normal")[0],
    ...withTexCoordRoles((set) => verticesOfKind("texCoord")[set]),
    color: verticesOfKind("color")[0],
  };
  return {
    attributes: byVertexRole((role) => byRole[role]),
    others: attributes.flatMap(({ kind, bits, vertices }) => (kind === "other" ? [{ bits, vertices }] : [])),
  };
}

/** Makes the array of an attribute from its decoded values. */
const makeArray: Readonly<Record<AttributeKind, (values: Int32Array, type: AttributeType) => VertexArray>> = {
  normal: directionsOf,
  texCoord: normalizedOf,
  color: normalizedOf,
  other: othersOf,
};

/** All arrays except the index. */
function verticesOf(patch: CompactPatch): Omit<PatchBuffers, "index"> {
  const { header, attributes } = patch;
  return {
    topology: header.topology,
    positionBits: header.positionBits,
    vertexCount: header.wedgeCount,
    coord: coordOf(patch),
    ...withRoles(
      header.attributes.map((type, i) => ({
        kind: type.kind,
        bits: type.bits,
        vertices: makeArray[type.kind](attributes[i]!, type),
      })),
    ),
  };
}

function orderedIndexOf({ header, wedges: { wedge }, connectivity: { fans } }: CompactPatch): IndexArray {
  if (header.topology !== "triangles") return indexOf(wedge, header.wedgeCount);
  return orderForVertexCache(wedge, fans, makeIndex(header.wedgeCount, wedge.length));
}

export function indexOf(corners: Int32Array, vertexCount: number): IndexArray {
  const index = makeIndex(vertexCount, corners.length);
  index.set(corners);
  return index;
}

function coordOf({ header, coordinates, connectivity, wedges: { seams } }: CompactPatch): VertexArray {
  const count = header.wedgeCount;
  const array =
    header.positionBits <= 8
      ? new Uint8Array(4 * count)
      : header.positionBits <= 16
        ? new Uint16Array(4 * count)
        : new Float32Array(3 * count);
  if (seams === undefined) return interleaved(coordinates.subarray(0, 3 * count), 3, array, 1);
  const stride = array.length / count;
  for (let w = 0; w < count; ++w) {
    const from = 3 * connectivity.vertex[seams.corner[w]!]!;
    array[stride * w] = coordinates[from]!;
    array[stride * w + 1] = coordinates[from + 1]!;
    array[stride * w + 2] = coordinates[from + 2]!;
  }
  return { array, components: 3, stride, offset: 0 };
}

/** Keeps signed numbers as they are. */
function directionsOf(values: Int32Array, { bits }: AttributeType): VertexArray {
  const count = values.length / 3;
  return interleaved(values, 3, bits <= 8 ? new Int8Array(4 * count) : new Int16Array(4 * count), 1);
}

/** Scales integers of `bits` bits to the whole range of bytes or 16-bit words, which the GPU normalizes. */
function normalizedOf(values: Int32Array, { components, bits }: AttributeType): VertexArray {
  const count = values.length / components;
  const stride = components === 2 ? 2 : 4; // GPUs read four bytes at once
  const array = bits <= 8 && components > 2 ? new Uint8Array(stride * count) : new Uint16Array(stride * count);
  const maxOutput = array instanceof Uint8Array ? 255 : 65535;
  return interleaved(values, components as 2 | 3 | 4, array, maxOutput / (2 ** bits - 1));
}

function othersOf(values: Int32Array, { components, bits }: AttributeType): VertexArray {
  const count = values.length / components;
  const stride = 4 * Math.ceil(components / 4);
  const array =
    bits <= 8
      ? new Uint8Array(stride * count)
      : bits <= 16
        ? new Uint16Array(components <= 2 ? 2 * count : stride * count)
        : new Float32Array(components * count);
  return interleaved(values, components as 1 | 2 | 3 | 4, array, 1);
}

function interleaved(values: Int32Array, components: 1 | 2 | 3 | 4, array: ElementArray, factor: number): VertexArray {
  const count = values.length / components;
  const stride = array.length / count;
  if (factor !== 1) {
    for (let n = 0; n < count; ++n) {
      for (let i = 0; i < components; ++i) array[stride * n + i] = Math.round(values[components * n + i]! * factor);
    }
  } else if (stride === components) {
    array.set(values);
  } else {
    for (let n = 0; n < count; ++n) {
      for (let i = 0; i < components; ++i) array[stride * n + i] = values[components * n + i]!;
    }
  }
  return { array, components, stride, offset: 0 };
}
