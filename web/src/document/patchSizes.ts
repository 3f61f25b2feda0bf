// Counts and estimates of sizes that follow from what the document states of a patch.

import type { PatchDescription } from "./description.ts";

/** Number of indices that a patch draws. */
export function cornerCountOf({ draws }: Pick<PatchDescription, "draws">): number {
  return draws.reduce((sum, { count }) => sum + count, 0);
}

/** Bytes of a patch in a file of SIG compact, by typical patches. */
export function compactBytesOf(patch: Pick<PatchDescription, "draws" | "vertexCount">): number {
  return 2 * patch.vertexCount + cornerCountOf(patch) / 6;
}
