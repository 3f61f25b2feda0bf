// Reads the header of a file, which precedes its streams: docs/formats/compact.md, "File".

import { attributeRows } from "../../stage/attributeRows.ts";
import { packedPositionBits } from "../../stage/packedPositionBits.ts";
import { DecodeError } from "../decodeError.ts";

export type Topology = "points" | "lines" | "triangles";
export const topologies: readonly (Topology | undefined)[] = [undefined, "points", "lines", "triangles"];

/** A patch may have several attributes of the kind "texCoord": the sets of texture coordinates, in order. */
export type AttributeKind = "normal" | "texCoord" | "color" | "other";
export const attributeKinds: readonly (AttributeKind | undefined)[] = ["normal", "texCoord", "color", "other"];

export interface AttributeType {
  readonly kind: AttributeKind;
  readonly components: number;
  readonly bits: number;
  /**
   * Normals only: predicted from triangle normals that all have the same weight, instead of one proportional to their
   * area.
   */
  readonly isUniform: boolean;
  /** Normals only: nothing is stored, the prediction is the normal. */
  readonly isDerived: boolean;
}

/** Properties that several patches of a file share. */
export interface PatchType {
  readonly topology: Topology;
  readonly positionBits: number;
  readonly isBase: boolean;
  /** Indices into the file's attributes. */
  readonly attributes: readonly number[];
}

/** The versions of the format. Version 2 predicts positions from more points and has grids of more than 16 bits. */
export type Version = 1 | 2;

export interface FileHeader {
  readonly version: Version;
  readonly attributes: readonly AttributeType[];
  readonly types: readonly PatchType[];
  readonly patchCount: number;
}

/**
 * Views of the payload. Each stream holds its data of all patches, one patch after the other; it is empty where no
 * patch has such data.
 */
export interface FileStreams {
  readonly sizes: Uint8Array;
  readonly connectivity: Uint8Array;
  readonly segments: Uint8Array;
  readonly positions: Uint8Array;
  readonly wedges: Uint8Array;
  /** One for each attribute of the header. */
  readonly attributes: readonly Uint8Array[];
}

/** Maximum sum over all patches of a file, for vertices, wedges and elements each. */
export const maxCount = 2 ** 20;
const maxPatchCount = 65536;
const maxTypeCount = 256;
const maxFileAttributeCount = 256;
const maxPatchAttributeCount = 16;
const magic = [0x49, 0x47, 0x43]; // IGC

export function cornersPerElement(topology: Topology): 1 | 2 | 3 {
  return topology === "triangles" ? 3 : topology === "lines" ? 2 : 1;
}

/** Safe for untrusted bytes. Throws DecodeError. */
export function readFileHeader(payload: Uint8Array): { header: FileHeader; streams: FileStreams } {
  const reader = new FieldReader(payload);
  const version = readVersion(reader);
  const attributes = Array.from({ length: readCount(reader, "attributes", maxFileAttributeCount) }, () =>
    readAttributeType(reader),
  );
  const types = Array.from({ length: readCount(reader, "types of patches", maxTypeCount) }, () =>
    readPatchType(reader, attributes.length),
  );
  if (types.some(({ isBase }) => isBase !== types[0]?.isBase))
    throw new DecodeError("malformed", "holds bases beside patches");
  const patchCount = within("number of patches", readCount(reader, "patches", maxPatchCount), 1, maxPatchCount);
  return { header: { version, attributes, types, patchCount }, streams: readStreams(reader, attributes.length) };
}

/** Reads the signature, the version and, from version 2 on, the features, of which there are none yet. */
function readVersion(reader: FieldReader): Version {
  const [first, second, third, version] = [reader.byte(), reader.byte(), reader.byte(), reader.byte()];
  if (first !== magic[0] || second !== magic[1] || third !== magic[2])
    throw new DecodeError("malformed", "is no image of compact");
  if (version !== 1 && version !== 2)
    throw new DecodeError("unsupported", `is of version ${version} of compact, which is not known`);
  if (version === 2 && reader.byte() !== 0)
    throw new DecodeError("unsupported", "has features of compact that are not known");
  return version;
}

function readCount(reader: FieldReader, what: string, max: number): number {
  const count = reader.number();
  if (count > max) throw new DecodeError("limit", `holds ${count} ${what}; ${max} are allowed`);
  return count;
}

function readPatchType(reader: FieldReader, attributeCount: number): PatchType {
  const topology = topologies[within("topology", reader.byte(), 1, 3)] ?? "points";
  const positionBits = within("bits of a position", reader.byte(), packedPositionBits.min, packedPositionBits.max);
  const isBase = within("flags", reader.byte(), 0, 1) === 1;
  if (isBase && topology !== "triangles") throw new DecodeError("malformed", `holds segments of ${topology}`);
  const count = within("number of attributes", reader.byte(), 0, maxPatchAttributeCount);
  const indices: number[] = [];
  while (indices.length < count) {
    const index = within("attribute", reader.byte(), 0, attributeCount - 1);
    if (indices.includes(index)) throw new DecodeError("malformed", "holds an attribute of a patch twice");
    indices.push(index);
  }
  return { topology, positionBits, isBase, attributes: indices };
}

function readAttributeType(reader: FieldReader): AttributeType {
  const kind = attributeKinds[within("kind of an attribute", reader.byte(), 0, 3)] ?? "other";
  const { components: minComponents, maxComponents } =
    kind === "other" ? { components: 1, maxComponents: 4 } : attributeRows[kind];
  const components = within("number of components", reader.byte(), minComponents, maxComponents);
  const bits = within("bits of an attribute", reader.byte(), kind === "normal" ? 4 : 1, kind === "other" ? 24 : 16);
  const mode = within("mode of an attribute", reader.byte(), 0, kind === "normal" ? 3 : 0);
  return { kind, components, bits, isUniform: (mode & 1) !== 0, isDerived: (mode & 2) !== 0 };
}

function readStreams(reader: FieldReader, attributeCount: number): FileStreams {
  const lengths = Array.from({ length: 5 + attributeCount }, () => reader.number());
  const [sizes, connectivity, segments, positions, wedges, ...attributes] = lengths.map((length) =>
    reader.bytes(length),
  ) as [Uint8Array, Uint8Array, Uint8Array, Uint8Array, Uint8Array, ...Uint8Array[]];
  return { sizes, connectivity, segments, positions, wedges, attributes };
}

/** Returns the value. Throws DecodeError where it is outside min .. max. */
export function within(what: string, value: number, min: number, max: number): number {
  if (value >= min && value <= max) return value;
  throw new DecodeError("malformed", `has ${value} as ${what}; ${min} to ${max} are allowed`);
}

/** Reads fields of a payload in order. */
class FieldReader {
  readonly #payload: Uint8Array;
  #at = 0;

  constructor(payload: Uint8Array) {
    this.#payload = payload;
  }

  bytes(length: number): Uint8Array {
    if (this.#payload.length - this.#at < length) throw new DecodeError("truncated", "ends before its streams do");
    this.#at += length;
    return this.#payload.subarray(this.#at - length, this.#at);
  }

  byte(): number {
    return this.bytes(1)[0]!;
  }

  /** A number below 2^28 in groups of seven bits, least significant first. */
  number(): number {
    let value = 0;
    for (let shift = 0; shift < 28; shift += 7) {
      const byte = this.byte();
      value |= (byte & 127) << shift;
      if (byte < 128) return value;
    }
    throw new DecodeError("malformed", "has a number that is too long in its header");
  }
}
