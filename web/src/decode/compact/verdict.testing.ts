// The outcome of decoding a file of compact as one value, which is the same for all readers
// (src/containers/compact/verdict.h computes it in C++).

import { DecodeError } from "../decodeError.ts";
import type { CompactPatch } from "./patch.ts";
import { decodePatches } from "./patch.ts";

/** A patch as the JSON of a vector states it. */
export interface StatedPatch {
  readonly topology: number;
  readonly positionBits: number;
  readonly positions: number[];
  readonly wedgePositions: number[];
  readonly corners: number[];
  /** Base meshes only: the segment of each triangle, and the number of segments. */
  readonly parts?: number[];
  readonly partCount?: number;
  readonly attributes: {
    readonly kind: number;
    readonly components: number;
    readonly bits: number;
    readonly mode: number;
    readonly values: number[];
  }[];
}

/** Converts a patch to the form of the vectors; for `decodePatches`. */
export function stated({
  header,
  coordinates,
  connectivity,
  wedges: { wedge, seams },
  attributes,
  segments,
}: CompactPatch): StatedPatch {
  const identity = Array.from({ length: header.wedgeCount }, (_, w) => w);
  return {
    topology: ["", "points", "lines", "triangles"].indexOf(header.topology),
    positionBits: header.positionBits,
    positions: Array.from(coordinates.subarray(0, 3 * header.vertexCount)),
    wedgePositions: seams ? Array.from(seams.corner, (corner) => connectivity.vertex[corner]!) : identity,
    corners: header.topology === "points" ? identity : Array.from(wedge),
    ...(segments && { parts: Array.from(segments.segment), partCount: header.segmentCount }),
    attributes: attributes.map((values, attributeIndex) => {
      const { kind, components, bits, isUniform, isDerived } = header.attributes[attributeIndex]!;
      return {
        kind: ["normal", "texCoord", "color", "other"].indexOf(kind),
        components,
        bits,
        mode: Number(isUniform) + 2 * Number(isDerived),
        values: Array.from(values),
      };
    }),
  };
}

/** The FNV-1a hash of all decoded numbers, as four little-endian bytes each. */
function hashOf(patches: readonly StatedPatch[]): number {
  let hash = 2166136261;
  const add = (numbers: readonly number[]) => {
    for (const number of numbers) {
      for (let shift = 0; shift < 32; shift += 8) hash = Math.imul(hash ^ ((number >>> shift) & 255), 16777619);
    }
  };
  for (const { positions, wedgePositions, corners, parts = [], attributes } of patches) {
    for (const numbers of [positions, wedgePositions, corners, parts, ...attributes.map(({ values }) => values)])
      add(numbers);
  }
  return hash >>> 0;
}

/** The hash of what a payload decodes to, or the kind of the DecodeError. Rethrows other errors. */
export function verdictOn(payload: Uint8Array): number | DecodeError["kind"] {
  try {
    return hashOf(decodePatches(payload, stated));
  } catch (error) {
    if (error instanceof DecodeError) return error.kind;
    throw error;
  }
}
