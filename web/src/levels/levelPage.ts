// Reads one page of the index of levels from bytes that may be damaged (docs/formats/levels.md, "Index").
// src/containers/levels/read_level_index.cpp does the same; vectors/levels-1 binds both.

import { DecodeError } from "../decode/decodeError.ts";

export const maxLevelGroups = 2 ** 22;
export const maxLevelPageGroups = 2 ** 16;
export const maxLevelCount = 32;
export const maxLevelPositionBits = 24;
/** Vertices, and triangles, of a group. */
export const maxGroupCount = 2 ** 20;
export const maxGroupBytes = 2 ** 28 - 1;
/** Columns, and rows, of the image of a group. */
export const maxChipImageEdge = 16384;
/** The features of an index whose groups hold points, or have images. */
const pointsFeature = 1;
const chipFeature = 4;

/** What page 0 states of the whole index. */
export interface LevelHeader {
  /** Groups of all levels. */
  readonly groupCount: number;
  /** Groups of each page but the last. */
  readonly pageGroups: number;
  /** Groups of the highest level: the first ones. */
  readonly rootCount: number;
  readonly positionBits: number;
  /** Version 1: the sphere of a group contains those of its children. */
  readonly hasNestedSpheres: boolean;
  /** Whether groups hold points in place of triangles. */
  readonly hasPoints: boolean;
  /** Whether each group, of triangles, has an image. */
  readonly hasChips: boolean;
  /** Sizes of the files of pages in bytes; 0 for the first, which is not stated. */
  readonly pageBytes: Uint32Array;
}

/** The groups of a page, from number `first` on, as stored: an element of each column for each group. */
export interface LevelPage {
  readonly first: number;
  readonly count: number;
  readonly levels: Uint8Array;
  /** x, y and z of each centre, in units of max(1, 2^(positionBits - 16)) lattice steps. */
  readonly centers: Uint16Array;
  /** In four times that unit; `unboundedRadius`: contains everything. */
  readonly radii: Uint16Array;
  /** 2^(code / 8) lattice steps; `rootErrorCode`: a root. */
  readonly errorCodes: Uint8Array;
  /** Vertices for the GPU, triangles and bytes of the files. Of points, which are vertices, there are 0 triangles. */
  readonly vertices: Uint32Array;
  readonly triangles: Uint32Array;
  readonly bytes: Uint32Array;
  /** The children of group `first` + i are `children` from `childStarts[i]` up to `childStarts[i + 1]`, ascending. */
  readonly childStarts: Uint32Array;
  readonly children: Uint32Array;
  /** Columns, rows and bytes of the groups' images; empty where there are none. */
  readonly chipColumns: Uint32Array;
  readonly chipRows: Uint32Array;
  readonly chipBytes: Uint32Array;
}

/** Reads page 0. Time and memory are proportional to the bytes. Throws DecodeError. */
export function readFirstPage(payload: Uint8Array): { header: LevelHeader; page: LevelPage } {
  const reader = new PageReader(payload);
  const header = readHeader(reader, readBeginning(reader, 0));
  return { header, page: readColumns(reader, header, 0) };
}

/** Reads page `page`, 1 or more. Throws DecodeError. */
export function readFurtherPage(payload: Uint8Array, header: LevelHeader, page: number): LevelPage {
  const reader = new PageReader(payload);
  const { version, features } = readBeginning(reader, page);
  check(features === featuresOf(header), "has other features than the first page");
  check((version === 1) === header.hasNestedSpheres, "has another version than the first page");
  return readColumns(reader, header, page * header.pageGroups);
}

/** Throws unless the condition is true; `message` is a predicate, as that of DecodeError. */
export function check(condition: boolean, message: string): asserts condition {
  if (!condition) throw new DecodeError("malformed", message);
}

export function checkGroup(condition: boolean, group: number, message: string): asserts condition {
  if (!condition) throw new DecodeError("malformed", `states that group ${group} ${message}`);
}

class PageReader {
  readonly #bytes: Uint8Array;
  #at = 0;

  constructor(bytes: Uint8Array) {
    this.#bytes = bytes;
  }

  byte(): number {
    if (this.#at === this.#bytes.length) throw new DecodeError("truncated", "ends before its last group");
    return this.#bytes[this.#at++]!;
  }

  /** A number below 2^28, stored as seven bits in each byte, the low ones first. */
  number(): number {
    let value = 0;
    for (let shift = 0; shift < 28; shift += 7) {
      const next = this.byte();
      value |= (next & 127) << shift;
      if (next < 128) return value;
    }
    throw new DecodeError("malformed", "states a number that is too long");
  }

  /** A number of things, 1 … max. */
  count(max: number, things: string): number {
    const value = this.number();
    check(value > 0, `states no ${things}`);
    if (value > max) throw new DecodeError("limit", `states more than ${max} ${things}`);
    return value;
  }

  /** `count` bytes, which must be there before memory is taken for them. */
  column(count: number): Uint8Array {
    if (count > this.#bytes.length - this.#at) throw new DecodeError("truncated", "ends before its last group");
    this.#at += count;
    return this.#bytes.slice(this.#at - count, this.#at);
  }

  /** Numbers of 16 bits: their low bytes, then their high ones. */
  planes(count: number): Uint16Array {
    const low = this.column(count);
    const high = this.column(count);
    return Uint16Array.from(low, (byte, index) => byte | (high[index]! << 8));
  }

  counts(count: number, max: number, things: string): Uint32Array {
    return Uint32Array.from({ length: count }, () => this.count(max, things));
  }
}

interface PageBeginning {
  readonly version: number;
  readonly features: number;
}

function readBeginning(reader: PageReader, page: number): PageBeginning {
  const begin = [reader.byte(), reader.byte(), reader.byte(), reader.byte()];
  check(String.fromCharCode(...begin.slice(0, 3)) === "IGL", "is no index of levels");
  const version = begin[3]!;
  if (version !== 1 && version !== 2)
    throw new DecodeError("unsupported", `is an index of levels of version ${version}; 1 and 2 are read`);
  const features = reader.byte();
  if (![0, pointsFeature, chipFeature].includes(features))
    throw new DecodeError("unsupported", "has features that are not known");
  check(reader.number() === page, "is another page of an index of levels");
  return { version, features };
}

function featuresOf({ hasPoints, hasChips }: LevelHeader): number {
  return hasPoints ? pointsFeature : hasChips ? chipFeature : 0;
}

function readHeader(reader: PageReader, { version, features }: PageBeginning): LevelHeader {
  const groupCount = reader.count(maxLevelGroups, "groups");
  const pageGroups = reader.count(maxLevelPageGroups, "groups a page");
  const rootCount = reader.count(maxLevelGroups, "roots");
  check(rootCount <= groupCount, "states more roots than groups");
  const positionBits = reader.byte();
  check(positionBits >= 1 && positionBits <= maxLevelPositionBits, "states impossible position bits");
  const pageBytes = [0]; // grows with the bytes that are there
  const pages = Math.ceil(groupCount / pageGroups);
  while (pageBytes.length < pages) pageBytes.push(reader.count(maxGroupBytes, "bytes of a page"));
  return {
    ...{ groupCount, pageGroups, rootCount, positionBits },
    hasNestedSpheres: version === 1,
    hasPoints: features === pointsFeature,
    hasChips: features === chipFeature,
    pageBytes: Uint32Array.from(pageBytes),
  };
}

function readColumns(reader: PageReader, header: LevelHeader, first: number): LevelPage {
  const { groupCount, pageGroups, hasPoints, hasChips } = header;
  const count = Math.min(pageGroups, groupCount - first);
  const levels = readLevels(reader, first, count);
  const centers = new Uint16Array(3 * count);
  for (let axis = 0; axis < 3; ++axis) {
    const differences = reader.planes(count);
    for (let i = 0, value = 0; i < count; ++i) centers[3 * i + axis] = value += differences[i]!;
  }
  const radii = reader.planes(count);
  const errorCodes = reader.column(count);
  const vertices = reader.counts(count, maxGroupCount, "vertices of a group");
  const triangles = hasPoints ? new Uint32Array(count) : reader.counts(count, maxGroupCount, "triangles of a group");
  const elements = hasPoints ? vertices : triangles;
  const bytes = reader.counts(count, maxGroupBytes, "bytes of a group");
  const childStarts = new Uint32Array(count + 1);
  for (let i = 0; i < count; ++i) {
    const childCount = reader.number();
    checkGroup(childCount <= elements[i]!, first + i, "has more children than triangles or points");
    checkGroup((childCount === 0) === (levels[i] === 0), first + i, "has children on level 0, or none above");
    childStarts[i + 1] = childStarts[i]! + childCount;
  }
  const children: number[] = []; // grows with the bytes that are there
  for (let i = 0; i < count; ++i)
    for (let child = first + i; children.length < childStarts[i + 1]!; children.push(child)) {
      const difference = reader.number();
      const isGroup = difference > 0 && difference < groupCount - child;
      checkGroup(isGroup, first + i, "has children that do not exist");
      child += difference;
    }
  const chipCount = hasChips ? count : 0;
  const chipColumns = reader.counts(chipCount, maxChipImageEdge, "columns of an image");
  const chipRows = reader.counts(chipCount, maxChipImageEdge, "rows of an image");
  const chipBytes = reader.counts(chipCount, maxGroupBytes, "bytes of an image");
  return {
    ...{ chipColumns, chipRows, chipBytes },
    ...{ first, count, levels, centers, radii, errorCodes, vertices, triangles, bytes, childStarts },
    children: Uint32Array.from(children),
  };
}

/** A wrong level is found before the end of the bytes is, as in C++. */
function readLevels(reader: PageReader, first: number, count: number): Uint8Array {
  const levels: number[] = [];
  while (levels.length < count) {
    const level = reader.byte();
    checkGroup(level < maxLevelCount, first + levels.length, "has an impossible level");
    levels.push(level);
  }
  return Uint8Array.from(levels);
}
