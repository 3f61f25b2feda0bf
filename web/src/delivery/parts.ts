// The files that a patch needs, each with its rank in the queue.

import { byteSizeOf } from "../decode/elements.ts";
import type { GeometryDescription, PatchDescription, Reference } from "../document/description.ts";

export interface Part {
  readonly role: "index" | "coord" | "normal" | "color";
  /** Which byte plane, for `coord` of images. */
  readonly plane: number;
  readonly reference: Reference;
  readonly priority: number;
  readonly expectedBytes: number;
}

/**
 * The order of paper section 5.4 ("chunk type"), over all patches of the scene:
 * the first coordinate byte, what makes a surface of it, how it is lit and
 * coloured, then the further bytes. Texture coordinates are not asked for:
 * nothing that the document can say yet uses them.
 */
export function partsOf(geometry: GeometryDescription, patch: PatchDescription): Part[] {
  const corners = patch.draws.reduce((sum, draw) => sum + draw.count, 0);
  const vertices = patch.vertexCount;
  const part = (role: Part["role"], reference: Reference | undefined, priority: number,
                expectedBytes: number, plane = 0): Part[] =>
    reference === undefined ? [] : [{ role, plane, reference, priority, expectedBytes }];
  const bytesOf = (role: Part["role"]) => geometry.container === "sig" ? sigBytes[role]
    : byteSizeOf(geometry[`${role}Type`]) * { index: 1, coord: 3, normal: 3, color: geometry.colorComponents }[role];
  return [
    ...patch.coord.flatMap((plane, place) =>
      part("coord", plane, place === 0 ? 0 : 3 + place, vertices * bytesOf("coord"), place)),
    ...part("index", patch.index, 1, corners * bytesOf("index")),
    ...part("normal", patch.normal, 2, vertices * bytesOf("normal")),
    ...part("color", patch.color, 3, vertices * bytesOf("color")),
  ];
}

/** What a vertex (a corner, for the index) weighs in an image, roughly: only for the bar before servers tell sizes. */
const sigBytes = { index: 0.7, coord: 2, normal: 2.2, color: 2 } as const;
