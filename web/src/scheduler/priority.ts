// One number for each request (paper section 5.4, "Priority Controlled
// Rendering"): what the author says, times what the file holds, times what the
// camera sees. Larger goes first.

import type { ViewMetrics } from "./viewMetrics.ts";

/** What a file holds, for the second factor. `refinement` is every byte of a coordinate after the first, `patch` all of a patch, `base` a coarse shape of all patches, `preview` a texture in few pixels. */
export const chunkTypes = [
  "base",
  "patch",
  "coord",
  "preview",
  "index",
  "normal",
  "texCoord",
  "color",
  "refinement",
  "texture",
] as const;
export type ChunkType = (typeof chunkTypes)[number];
export type ChunkWeights = Readonly<Record<ChunkType, number>>;

/**
 * First a shape, then what makes it better. A step is a factor of 4, the same as
 * that of an author's `high`, and as that of being 16 times as large on the
 * screen: among the patches of one object, and among objects of about the same
 * size, all are coarse before one is fine; but nobody waits with an object that
 * fills the screen for the dots of one that is hardly seen.
 */
export const defaultChunkWeights: ChunkWeights = {
  base: 4096,
  patch: 1024,
  coord: 1024,
  preview: 512,
  index: 256,
  normal: 64,
  texCoord: 32,
  color: 16,
  refinement: 4,
  texture: 1,
};

/** Byte planes after the second are worth this much of the one before. */
const furtherPlaneFactor = 1 / 4;

/** Off the screen is fetched too, since turning the head is quick, but after what is seen. */
const outOfViewFactor = 1 / 4096;

/** Neither is more than this worth telling apart. */
const minPixels = 1;
const maxPixels = 4096;

export interface Chunk {
  readonly type: ChunkType;
  /** Which byte of the coordinate, for `refinement`: 1 is the second. */
  readonly plane: number;
}

/** `content` is the author's factor, 0 or more; 1 where nothing is said. */
export function priorityOf(
  content: number,
  chunk: Chunk,
  view: ViewMetrics,
  weights: ChunkWeights = defaultChunkWeights,
): number {
  const type =
    chunk.type === "refinement" ? weights.refinement * furtherPlaneFactor ** (chunk.plane - 1) : weights[chunk.type];
  return content * type * weightOfView(view);
}

/** Grows with the square root of the size on the screen: size differs by thousands, and must not drown the other factors. */
export function weightOfView({ pixels, isInView }: ViewMetrics): number {
  const size = Math.sqrt(Math.min(Math.max(pixels, minPixels), maxPixels));
  return isInView ? size : size * outOfViewFactor;
}

/**
 * The default weights changed by declarations such as "normal: 8; refinement: 200",
 * as an author writes them for a scene. What cannot be read is told to `onProblem`.
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
