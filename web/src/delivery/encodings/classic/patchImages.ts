// What a patch states of its images: how many byte planes an attribute has, and which texels its records are.

import type { RecordLayout } from "../../../decode/classic/classicArrays.ts";
import type { ImageHeader } from "../../../decode/imageFile.ts";
import type { PatchDescription } from "../../../document/description.ts";
import { cornerCountOf } from "../../../document/patchSizes.ts";
import type { VertexRole } from "../../../stage/attributeRows.ts";

export type ImageSize = Pick<ImageHeader, "width" | "height">;

export function planeCountOf({ lowBytes }: Pick<PatchDescription, "lowBytes">, role: VertexRole): number {
  return 1 + (lowBytes[role]?.length ?? 0);
}

/** Where the records of a patch are in an image of this size that begins at `firstTexel`. */
export function recordLayoutOf(patch: PatchDescription, { width, height }: ImageSize, firstTexel = 0): RecordLayout {
  const { index, grid, vertexCount, implicitWidth } = patch;
  if (grid !== undefined) return { count: vertexCount, rowLength: implicitWidth };
  if (index === undefined) return { count: cornerCountOf(patch), rowLength: implicitWidth };
  return { count: vertexCount || width * height - firstTexel, rowLength: 0 };
}

/** Vertices in a row of the patch's images. `size`: of the first one of the coordinates; undefined: there is none. */
export function columnsOf({ index, grid, implicitWidth }: PatchDescription, size: ImageSize | undefined): number {
  return grid === undefined && index !== undefined ? (size?.width ?? 1) : implicitWidth;
}
