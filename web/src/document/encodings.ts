// The document format of each encoding, one row each. Stage builders are in delivery/encodings. Mirrors
// src/containers/encodings.h.

import type { VertexRole } from "../stage/attributeRows.ts";
import type { ElementType } from "../stage/elementType.ts";
import { packedPositionBits } from "../stage/packedPositionBits.ts";
import type { Encoding, GeometryDescription, ImageProfile, PatchDescription, Reference } from "./description.ts";
import { UnreadableGeometry } from "./unreadableGeometry.ts";

export interface EncodingFormat {
  /** The value of an ImageGeometry's `profile` field; undefined: a BinaryGeometry. */
  readonly profile: ImageProfile | undefined;
  /**
   * `packed`: one range of bytes holds all of a patch. `bytePlanes`: an image for each byte of a value, which the
   * GPU can read. `arrays`: arrays of an ElementType.
   */
  readonly storage: "packed" | "bytePlanes" | "arrays";
  /** A file with a base mesh may stand in for the patches. */
  readonly hasBase: boolean;
  /** Patches may be grids without an index (`implicitMeshMode`). */
  readonly hasGrids: boolean;
  /** The largest number of files that the coordinates of a patch can have. */
  readonly maxCoordFileCount: number;
  /** The largest number of files that an attribute of a patch can have. */
  maxAttributeFileCount(role: VertexRole): number;
  /** The number of files of each patch for one custom attribute whose numbers have `valueBits` bits. */
  attributeFileCount(valueBits: number): number;
  /** Bits of a custom attribute's stored integers; undefined: numbers are stored as they are. */
  attributeBits(valueBits: number): number | undefined;
  /** `fragment`: what follows the URL's `#`; undefined where there is none. Throws UnreadableGeometry where it is none. */
  referenceOf(url: string, fragment: string | undefined): Reference;
  /** The stored value of the upper side of the quantization box. */
  maxStoredValue(geometry: GeometryDescription, patch: PatchDescription): number;
}

/** The largest value of each element type, which stands for 1 (X3DOM's PMAX). */
const maxElementValues: Readonly<Record<ElementType, number>> = {
  Int8: 127,
  Uint8: 255,
  Int16: 32767,
  Uint16: 65535,
  Int32: 2147483647,
  Uint32: 4294967295,
  Float32: 1,
};

/** Byte planes that coordinates can have: 32 bits. */
const maxCoordPlaneCount = 4;

const classic: EncodingFormat = {
  profile: "classic",
  storage: "bytePlanes",
  hasBase: false,
  hasGrids: true,
  maxCoordFileCount: maxCoordPlaneCount,
  maxAttributeFileCount: (role) => (role === "color" ? 3 : 2), // 24 bits, 16 bits of normals
  attributeFileCount: (valueBits) => valueBits / 8,
  attributeBits: (valueBits) => valueBits,
  referenceOf: (url, fragment) => ({ url, firstTexel: numberIn(fragment) }),
  maxStoredValue: (_, patch) => 256 ** Math.max(1, patch.coord.length) - 1,
};

export const encodingFormats: Readonly<Record<Encoding, EncodingFormat>> = {
  compact: {
    profile: "compact",
    storage: "packed",
    hasBase: true,
    hasGrids: false,
    maxCoordFileCount: 1,
    maxAttributeFileCount: () => 1,
    attributeFileCount: () => 0,
    attributeBits: (valueBits) => valueBits,
    referenceOf: (url, fragment) => ({ url, patchIndex: numberIn(fragment) }),
    maxStoredValue: (geometry) => maxLatticeValue(latticeBitsOf(geometry)),
  },
  classic,
  live: { ...classic, profile: undefined, attributeFileCount: () => 0 },
  bg: {
    profile: undefined,
    storage: "arrays",
    hasBase: false,
    hasGrids: false,
    maxCoordFileCount: 1,
    maxAttributeFileCount: () => 1,
    attributeFileCount: () => 1,
    attributeBits: () => undefined,
    referenceOf(url, fragment) {
      // In X3DOM's "file.bin+S", "+S" gives the stride and is a part of the file's name; base64 has a '+' too.
      const stated = url.startsWith("data:") ? undefined : /\+(\d+)$/.exec(url)?.[1];
      if (fragment === undefined) return { url, byteOffset: 0, byteStride: numberIn(stated) };
      const plus = fragment.indexOf("+");
      const [offset, stride] = plus < 0 ? [fragment] : [fragment.slice(0, plus), fragment.slice(plus + 1)];
      return { url, byteOffset: numberIn(offset), byteStride: numberIn(stride) };
    },
    maxStoredValue: ({ coordType }) => maxElementValues[coordType],
  },
};

export function formatOf({ encoding }: Pick<GeometryDescription, "encoding">): EncodingFormat {
  return encodingFormats[encoding];
}

/** Bits of a lattice coordinate in compact. */
export function latticeBitsOf({ positionBits }: GeometryDescription): number {
  return positionBits > 0 ? positionBits : packedPositionBits.default;
}

/**
 * The lattice coordinate of the box's upper side, which may be fractional: the box spans all values of whole bytes, of
 * which compact stores the upper `bits` bits.
 */
function maxLatticeValue(bits: number): number {
  const bytes = Math.ceil(bits / 8);
  return (256 ** bytes - 1) / 2 ** (8 * bytes - bits);
}

/** A number of a fragment; 0 where there is none. Throws UnreadableGeometry for text that is no number of 32 bits. */
function numberIn(text: string | undefined): number {
  if (text === undefined) return 0;
  const value = /^\d+$/.test(text) ? Number(text) : NaN;
  if (!(value < 2 ** 32)) throw new UnreadableGeometry("a reference's fragment is not an index in its file");
  return value;
}
