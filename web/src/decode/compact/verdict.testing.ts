// What comes of a file of compact, in one word that every reader is held to
// (src/containers/compact/verdict.h has the same).

import { DecodeError } from "../decodeError.ts";
import type { CompactPatch } from "./patch.ts";
import { decodePatches } from "./patch.ts";

/** What a vector's JSON states of each patch. */
export interface StatedPatch {
  readonly topology: number;
  readonly positionBits: number;
  readonly positions: number[];
  readonly wedgePositions: number[];
  readonly corners: number[];
  /** Of a base. */
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

/** A patch in the words of the vectors; for `decodePatches`. */
export function stated({
  header,
  coordinates,
  connectivity,
  wedges: { wedge, seams },
  attributes,
  segments: parts,
}: CompactPatch): StatedPatch {
  const running = Array.from({ length: header.wedgeCount }, (_, w) => w);
  return {
    topology: ["", "points", "lines", "triangles"].indexOf(header.topology),
    positionBits: header.positionBits,
    positions: Array.from(coordinates.subarray(0, 3 * header.vertexCount)),
    wedgePositions: seams ? Array.from(seams.corner, (corner) => connectivity.vertex[corner]!) : running,
    corners: header.topology === "points" ? running : Array.from(wedge),
    ...(parts && { parts: Array.from(parts.segment), partCount: header.segmentCount }),
    attributes: attributes.map((values, place) => {
      const { kind, components, bits, isUniform, isDerived } = header.attributes[place]!;
      return {
        kind: ["normal", "texCoord", "color", "other"].indexOf(kind),
        components,
        bits,
        mode: Number(isUniform) + 2 * Number(isDerived),
        values: Array.from(values, (value) => value + 0),
      };
    }),
  };
}

/** FNV-1a over every number that decodes, as four little-endian bytes each. */
function sumOf(patches: readonly StatedPatch[]): number {
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

/** The sum of what a payload decodes to, or the kind of its refusal. Throws what is no DecodeError. */
export function verdictOn(payload: Uint8Array): number | DecodeError["kind"] {
  try {
    return sumOf(decodePatches(payload, stated));
  } catch (error) {
    if (error instanceof DecodeError) return error.kind;
    throw error;
  }
}
