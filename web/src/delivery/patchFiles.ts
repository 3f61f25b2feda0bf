// The files that a patch needs.

import { byteSizeOf } from "../stage/elementType.ts";
import type { ElementType, GeometryDescription, PatchDescription, Reference } from "../document/description.ts";
import { hasNormalsInCoords, isPair } from "../document/geometry.ts";
import type { Chunk } from "../scheduler/priority.ts";

/** What a file may hold of a patch. */
export type FileRole = "index" | "coord" | "normal" | "texCoord" | "color" | "value";

export interface PatchFile {
  /** `patch`: all of it. `base`: what stands in for it, and for others. */
  readonly role: FileRole | "patch" | "base";
  /** Which byte plane, for `coord` and `value` of images. */
  readonly plane: number;
  readonly reference: Reference;
  /** What it is to the order of requests. */
  readonly chunk: Chunk;
  /** Of what the patch needs of the file. */
  readonly expectedBytes: number;
  /** What it is likely to take on the GPU, until it is there. */
  readonly storedBytes: number;
}

export function patchFilesOf(geometry: GeometryDescription, patch: PatchDescription): PatchFile[] {
  if (geometry.container === "compact") {
    return [
      ...(geometry.base ? [basePart(patch, geometry.base)] : []),
      ...(patch.data ? [compactPart(patch, patch.data)] : []),
    ];
  }
  const corners = patch.draws.reduce((sum, draw) => sum + draw.count, 0);
  const vertices = patch.vertexCount;
  const part = (role: FileRole, reference: Reference | undefined, elements: number, plane = 0): PatchFile[] =>
    reference === undefined
      ? []
      : [
          {
            role,
            plane,
            reference,
            expectedBytes:
              elements * (geometry.container === "sig" ? sigBytes[role] : reference.stride || bytesOf(geometry, role)),
            storedBytes:
              geometry.container === "sig"
                ? bytesPerTexel * texelsOf(patch, role, elements)
                : elements * (reference.stride || bytesOf(geometry, role)),
            chunk: role === "value" ? { type: "color", plane } : { type: plane > 0 ? "refinement" : role, plane },
          },
        ];
  return [
    ...patch.coord.flatMap((plane, place) => part("coord", plane, vertices, place)),
    ...part("index", patch.index, corners),
    ...(hasNormalsInCoords(geometry, patch) ? [] : part("normal", patch.normal, vertices)),
    ...part("texCoord", patch.texCoord, vertices),
    ...part("color", patch.color, vertices),
    ...patch.value.flatMap((plane, place) => part("value", plane, vertices, place)),
  ];
}

function compactPart(patch: PatchDescription, reference: Reference): PatchFile {
  return { role: "patch", plane: 0, reference, chunk: { type: "patch", plane: 0 }, ...compactSizes(patch) };
}

/** What a base has of its patches' triangles, and bytes, roughly. */
const shareOfBase = 0.03;

function basePart(patch: PatchDescription, reference: Reference): PatchFile {
  const { expectedBytes, storedBytes } = compactSizes(patch);
  return {
    role: "base",
    plane: 0,
    reference,
    chunk: { type: "base", plane: 0 },
    expectedBytes: shareOfBase * expectedBytes,
    storedBytes: shareOfBase * storedBytes,
  };
}

function compactSizes({ draws, vertexCount }: PatchDescription): Pick<PatchFile, "expectedBytes" | "storedBytes"> {
  const corners = draws.reduce((sum, draw) => sum + draw.count, 0);
  return {
    expectedBytes: 2 * vertexCount + corners / 6,
    storedBytes: 12 * vertexCount + 2 * corners, // words of positions, bytes of normals, short indices
  };
}

/** Of an image, as our writer lays it out: records in a power of two of rows of 256. */
function texelsOf({ implicitWidth }: PatchDescription, role: FileRole, elements: number): number {
  if (role === "index") return Math.ceil(elements / implicitWidth) * implicitWidth;
  return 256 * 2 ** Math.ceil(Math.log2(Math.max(1, elements / 256)));
}

/** Of textures: three channels are stored as four. */
export const bytesPerTexel = 4;

function bytesOf(geometry: GeometryDescription, role: FileRole): number {
  return byteSizeOf(typeOf(geometry, role)) * componentsOf(geometry, role);
}

/** Of the elements of typed arrays. */
export function typeOf(geometry: GeometryDescription, role: FileRole): ElementType {
  return role === "value" ? "Float32" : geometry[`${role}Type`];
}

/** The numbers of one element in typed arrays. */
export function componentsOf(geometry: GeometryDescription, role: FileRole): 1 | 2 | 3 | 4 {
  switch (role) {
    case "index":
      return 1;
    case "coord":
      return 3;
    case "normal":
      return isPair(geometry.normalEncoding) ? 2 : 3;
    case "texCoord":
      return 2;
    case "color":
      return geometry.colorComponents;
    case "value":
      return geometry.value?.components ?? 1;
  }
}

/** What a vertex (a corner, for the index) weighs in an image, roughly: only for the bar before servers tell sizes. */
const sigBytes = { index: 0.7, coord: 2, normal: 2.2, texCoord: 3, color: 2, value: 0.7 } as const;
