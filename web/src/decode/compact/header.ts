// What stands before the streams of a patch: docs/formats/compact.md, "File".
// All counts are checked here, before anything is allocated for them.

import { DecodeError } from "../decodeError.ts";

export type Topology = "points" | "lines" | "triangles";
const topologies: readonly (Topology | undefined)[] = [undefined, "points", "lines", "triangles"];

export type AttributeKind = "normal" | "texCoord" | "color" | "other";
const attributeKinds: readonly (AttributeKind | undefined)[] = ["normal", "texCoord", "color", "other"];

export interface AttributeType {
  readonly kind: AttributeKind;
  readonly components: number;
  readonly bits: number;
  /** Normals only: predicted from triangles that count alike, whatever their area. */
  readonly isUniform: boolean;
  /** Normals only: the prediction is the normal. */
  readonly isDerived: boolean;
}

/** The planes on which isosurfaces have their vertices, each axis its own, in 1/65536 lattice steps. */
export interface Grid {
  readonly origin: Float64Array;
  readonly step: Float64Array;
}

export interface PatchHeader {
  readonly topology: Topology;
  readonly positionBits: number;
  readonly normalShift: number;
  readonly grid: Grid | undefined;
  readonly vertexCount: number;
  readonly wedgeCount: number;
  readonly elementCount: number;
  readonly attributes: readonly AttributeType[];
  /** Of a base: how many patches it stands in for; 0: it is a patch. */
  readonly partCount: number;
  /** Of a base: positions that one part alone has come in residuals of 2^residualShift. */
  readonly residualShift: number;
}

/** Views of the payload. */
export interface PatchStreams {
  /** Undefined in points. */
  readonly connectivity: Uint8Array | undefined;
  /** Undefined but in a base. */
  readonly parts: Uint8Array | undefined;
  readonly positions: Uint8Array;
  /** Undefined where each vertex is one wedge. */
  readonly wedges: Uint8Array | undefined;
  readonly attributes: readonly Uint8Array[];
}

export const largestCount = 2 ** 20;
const mostAttributes = 16;
const magic = [0x49, 0x47, 0x43]; // IGC
const version = 1;
const gridFlag = 1;
const partsFlag = 2;

export function cornersPerElement(topology: Topology): 1 | 2 | 3 {
  return topology === "triangles" ? 3 : topology === "lines" ? 2 : 1;
}

export interface ReadPatchHeader {
  readonly header: PatchHeader;
  readonly streams: PatchStreams;
  /** The first byte behind the patch. */
  readonly end: number;
}

/** Reads the patch at a byte of a payload. Safe for untrusted bytes. Throws DecodeError. */
export function readPatchHeader(payload: Uint8Array, start: number): ReadPatchHeader {
  const reader = new FieldReader(payload, start);
  const [first, second, third, patchVersion] = [reader.byte(), reader.byte(), reader.byte(), reader.byte()];
  if (first !== magic[0] || second !== magic[1] || third !== magic[2]) {
    throw new DecodeError("malformed", `holds no patch at byte ${start}`);
  }
  if (patchVersion !== version) throw new DecodeError("unsupported", `holds a patch of version ${patchVersion}, not ${version}`);
  const topology = topologies[within("topology", reader.byte(), 1, 3)] ?? "points";
  const positionBits = within("bits of a position", reader.byte(), 1, 30);
  const normalShift = within("shift of normals", reader.byte(), 0, 30);
  const flags = within("flags", reader.byte(), 0, gridFlag | partsFlag);
  const hasGrid = (flags & gridFlag) !== 0;
  const vertexCount = readCount(reader, "vertices", 1);
  const wedgeCount = readCount(reader, "wedges", vertexCount);
  const elementCount = readCount(reader, "elements", Math.ceil(wedgeCount / cornersPerElement(topology)));
  if (topology === "points") {
    within("number of wedges", wedgeCount, vertexCount, vertexCount);
    within("number of points", elementCount, vertexCount, vertexCount);
  }
  const attributeCount = within("number of attributes", reader.number(), 0, mostAttributes);
  const attributes = Array.from({ length: attributeCount }, () => readAttributeType(reader));
  if (hasGrid) within("bits of a position on a grid", positionBits, 1, 16);
  const grid = hasGrid ? readGrid(reader) : undefined;
  let partCount = 0;
  let residualShift = 0;
  if ((flags & partsFlag) !== 0) {
    if (topology !== "triangles") throw new DecodeError("malformed", `holds parts of ${topology}`);
    partCount = readCount(reader, "parts", 1, elementCount);
    residualShift = within("shift of residuals", reader.number(), 0, positionBits - 1);
  }
  const header = { topology, positionBits, normalShift, grid, vertexCount, wedgeCount, elementCount, attributes, partCount, residualShift };
  return { header, streams: readStreams(reader, header), end: reader.at };
}

function readCount(reader: FieldReader, what: string, least: number, most = largestCount): number {
  const count = reader.number();
  if (count > largestCount) throw new DecodeError("limit", `holds a patch of ${count} ${what}; ${largestCount} are allowed`);
  return within(`number of ${what}`, count, least, most);
}

function readAttributeType(reader: FieldReader): AttributeType {
  const kind = attributeKinds[within("kind of an attribute", reader.byte(), 0, 3)] ?? "other";
  const [fewest, most] = ({ normal: [3, 3], texCoord: [2, 2], color: [3, 4], other: [1, 4] } as const)[kind];
  const components = within("number of components", reader.byte(), fewest, most);
  const bits = within("bits of an attribute", reader.byte(), kind === "normal" ? 4 : 1, kind === "other" ? 24 : 16);
  const mode = within("mode of an attribute", reader.byte(), 0, kind === "normal" ? 3 : 0);
  return { kind, components, bits, isUniform: (mode & 1) !== 0, isDerived: (mode & 2) !== 0 };
}

function readGrid(reader: FieldReader): Grid {
  const origin = new Float64Array(3);
  const step = new Float64Array(3);
  for (let axis = 0; axis < 3; ++axis) {
    origin[axis] = reader.number();
    step[axis] = within("step of the grid", reader.number(), 131072, 2 ** 32 - 1);
    within("origin of the grid", origin[axis]!, 0, step[axis]! - 1);
  }
  return { origin, step };
}

function readStreams(reader: FieldReader, header: PatchHeader): PatchStreams {
  const hasConnectivity = header.topology !== "points";
  const hasParts = header.partCount > 0;
  const hasWedges = header.wedgeCount > header.vertexCount;
  const count = Number(hasConnectivity) + Number(hasParts) + 1 + Number(hasWedges) + header.attributes.length;
  const lengths = Array.from({ length: count }, () => reader.number());
  const streams = lengths.map((length) => reader.bytes(length)).values();
  const next = () => streams.next().value ?? new Uint8Array();
  return {
    connectivity: hasConnectivity ? next() : undefined,
    parts: hasParts ? next() : undefined,
    positions: next(),
    wedges: hasWedges ? next() : undefined,
    attributes: header.attributes.map(next),
  };
}

function within(what: string, value: number, least: number, most: number): number {
  if (value >= least && value <= most) return value;
  throw new DecodeError("malformed", `has ${value} as ${what}; ${least} to ${most} are allowed`);
}

/** Takes little-endian numbers off a payload. */
class FieldReader {
  readonly #payload: Uint8Array;
  #at: number;

  constructor(payload: Uint8Array, start: number) {
    this.#payload = payload;
    this.#at = start;
  }

  get at(): number {
    return this.#at;
  }

  bytes(length: number): Uint8Array {
    if (this.#payload.length - this.#at < length) throw new DecodeError("truncated", "ends inside a patch");
    this.#at += length;
    return this.#payload.subarray(this.#at - length, this.#at);
  }

  byte(): number {
    return this.bytes(1)[0]!;
  }

  /** Of 32 bits. */
  number(): number {
    const [a, b, c, d] = this.bytes(4);
    return (a! | b! << 8 | c! << 16 | d! << 24) >>> 0;
  }
}
