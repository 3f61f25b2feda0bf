// The priority of a request (paper section 5.4, "Priority Controlled Rendering"): the author's factor, times the weight
// of what the file holds, times a weight of its size on the screen. Requests of larger priority are sent first.
// docs/formats/nodes.md, "Order of requests", describes it for authors.

import { attributeRows, byVertexRole, vertexRoles } from "../stage/attributeRows.ts";
import type { ViewMetrics } from "./viewMetrics.ts";

/**
 * What a file holds. `refinement`: a byte plane of coordinates after the first; `patch`: all of a patch; `base`: the
 * base mesh of all patches; `preview`: a small version of a texture.
 */
export const chunkTypes = [
  "base",
  "patch",
  "coord",
  "preview",
  "index",
  ...vertexRoles,
  "refinement",
  "texture",
] as const;
export type ChunkType = (typeof chunkTypes)[number];
export type ChunkWeights = Readonly<Record<ChunkType, number>>;

/**
 * Coarse shapes first, then their refinements. Most weights differ by a factor of 4 from the next, as much as an
 * author's `high` gives, or a size on the screen that is 16 times as large. So all patches of one object, and all
 * objects of about the same size, are coarse before one is fine; but an object that fills the screen does not wait for
 * one of a few pixels.
 */
export const defaultChunkWeights: ChunkWeights = {
  base: 4096,
  patch: 1024,
  coord: 1024,
  preview: 512,
  index: 256,
  ...byVertexRole((role) => attributeRows[role].chunkWeight),
  refinement: 4,
  texture: 1,
};

/** The weight of a byte plane after the second, relative to the one before it. */
const furtherPlaneFactor = 1 / 4;

/** Data out of view are requested too, since the camera may turn quickly, but after those in view. */
const outOfViewFactor = 1 / 4096;

/** Diameters in pixels are clamped to this range. */
const minPixels = 1;
const maxPixels = 4096;

export interface Chunk {
  readonly type: ChunkType;
  /** Index of the byte plane, for `refinement`: 1 is the second. */
  readonly plane: number;
}

/** `authorPriority`: the author's factor, 0 or more; 1 where the document states none. */
export function priorityOf(
  authorPriority: number,
  chunk: Chunk,
  view: ViewMetrics,
  weights: ChunkWeights = defaultChunkWeights,
): number {
  const type =
    chunk.type === "refinement" ? weights.refinement * furtherPlaneFactor ** (chunk.plane - 1) : weights[chunk.type];
  return authorPriority * type * weightOfView(view);
}

/**
 * Grows with the square root of the diameter: diameters differ by factors of thousands, and must not outweigh the other
 * factors.
 */
export function weightOfView({ pixels, isInView }: ViewMetrics): number {
  const size = Math.sqrt(Math.min(Math.max(pixels, minPixels), maxPixels));
  return isInView ? size : size * outOfViewFactor;
}

/**
 * The default weights changed by an author's declarations, such as "normal: 8; refinement: 200". Calls `onProblem` for
 * each declaration that is invalid.
 */
export function chunkWeightsOf(text: string, onProblem: (problem: string) => void): ChunkWeights {
  const weights: Record<ChunkType, number> = { ...defaultChunkWeights };
  for (const declaration of text.split(";")) {
    if (declaration.trim() === "") continue;
    const [name = "", value = "", ...rest] = declaration.split(":").map((word) => word.trim());
    const type = chunkTypes.find((known) => known.toLowerCase() === name.toLowerCase());
    const weight = value === "" || rest.length > 0 ? NaN : Number(value);
    if (type === undefined) onProblem(`"${name}" is none of ${chunkTypes.join(", ")}`);
    else if (!Number.isFinite(weight) || weight < 0) onProblem(`"${declaration.trim()}" gives no number of 0 or more`);
    else weights[type] = weight;
  }
  return weights;
}
