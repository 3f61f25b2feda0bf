// Decodes the sizes of each patch from the first stream of a file: docs/formats/compact.md, "Sizes". All counts are
// checked here, before anything is allocated for them.

import { DecodeError } from "../decodeError.ts";
import type { AttributeType, FileHeader, PatchType, Topology, Version } from "./header.ts";
import { cornersPerElement, maxCount, within } from "./header.ts";
import { numberModelCount, RangeDecoder } from "./rangeDecoder.ts";

const typeModels = 0;
const vertexModels = typeModels + numberModelCount;
const seamModels = vertexModels + numberModelCount;
const elementModels = seamModels + numberModelCount;
const shiftModels = elementModels + numberModelCount;
const segmentModels = shiftModels + numberModelCount;
const residualModels = segmentModels + numberModelCount;
const gridModel = residualModels + numberModelCount;
const modelCount = gridModel + 1;

/**
 * The planes on which the vertices of an isosurface lie, for each axis: the first one and their distance, in 1/65536
 * lattice steps.
 */
export interface Grid {
  readonly origin: Float64Array;
  readonly step: Float64Array;
}

export interface PatchHeader {
  readonly version: Version;
  readonly topology: Topology;
  readonly positionBits: number;
  /** Triangles: bits by which edges are shortened before their cross product, which is computed in 32 bits. */
  readonly normalShift: number;
  readonly grid: Grid | undefined;
  readonly vertexCount: number;
  readonly wedgeCount: number;
  readonly elementCount: number;
  readonly attributes: readonly AttributeType[];
  /** Number of patches that a base mesh stands in for; 0 in a patch. */
  readonly segmentCount: number;
  /** Base meshes: residuals of positions that only one segment uses are multiples of 2^residualShift. */
  readonly residualShift: number;
}

export interface SizedPatch {
  readonly type: PatchType;
  readonly header: PatchHeader;
}

/** The header of each patch of a file. Safe for untrusted bytes. Throws DecodeError. */
export function decodeSizes(stream: Uint8Array, { version, types, attributes, patchCount }: FileHeader): SizedPatch[] {
  const decoder = new RangeDecoder(stream, modelCount);
  const patches = Array.from({ length: patchCount }, (): SizedPatch => {
    const type = types[within("type of a patch", decoder.number(typeModels), 0, types.length - 1)]!;
    return {
      type,
      header: decodeHeader(
        decoder,
        version,
        type,
        type.attributes.map((attributeIndex) => attributes[attributeIndex]!),
      ),
    };
  });
  decoder.finish();
  for (const [what, field] of [
    ["vertices", "vertexCount"],
    ["wedges", "wedgeCount"],
    ["elements", "elementCount"],
  ] as const) {
    const count = patches.reduce((sum, { header }) => sum + header[field], 0);
    if (count > maxCount) throw new DecodeError("limit", `holds ${count} ${what}; ${maxCount} are allowed`);
  }
  return patches;
}

function decodeHeader(
  decoder: RangeDecoder,
  version: Version,
  { topology, positionBits, isBase }: PatchType,
  attributes: readonly AttributeType[],
): PatchHeader {
  const vertexCount = 1 + decoder.number(vertexModels);
  let wedgeCount = vertexCount;
  let elementCount = vertexCount;
  if (topology !== "points") {
    wedgeCount += decoder.number(seamModels);
    elementCount = 1 + decoder.number(elementModels);
    within("number of wedges", wedgeCount, 1, elementCount * cornersPerElement(topology));
  }
  const normalShift = topology === "triangles" ? within("shift of normals", decoder.number(shiftModels), 0, 30) : 0;
  const grid =
    positionBits <= grids[version].maxBits && decoder.bit(gridModel) === 1 ? decodeGrid(decoder, version) : undefined;
  const segmentCount = isBase ? 1 + decoder.number(segmentModels) : 0;
  const residualShift = isBase ? decoder.number(residualModels) : 0;
  if (isBase) {
    within("number of segments", segmentCount, 1, elementCount);
    within("shift of residuals", residualShift, 0, positionBits - 1);
  }
  return {
    version,
    topology,
    positionBits,
    normalShift,
    grid,
    vertexCount,
    wedgeCount,
    elementCount,
    attributes,
    segmentCount,
    residualShift,
  };
}

/** The largest number of bits of positions with a grid, the 16-bit words of its numbers, and the largest step. */
const grids = {
  1: { maxBits: 16, words: 2, maxStep: 2 ** 32 - 1 },
  2: { maxBits: 24, words: 3, maxStep: 2 ** 41 },
} as const;

function decodeGrid(decoder: RangeDecoder, version: Version): Grid {
  const { words, maxStep } = grids[version];
  const origin = new Float64Array(3);
  const step = new Float64Array(3);
  const number = () => {
    let value = 0;
    for (let i = 0; i < words; ++i) value += decoder.raw(16) * 65536 ** i;
    return value;
  };
  for (let axis = 0; axis < 3; ++axis) {
    origin[axis] = number();
    step[axis] = within("step of the grid", number(), 131072, maxStep);
    within("origin of the grid", origin[axis]!, 0, step[axis]! - 1);
  }
  return { origin, step };
}
