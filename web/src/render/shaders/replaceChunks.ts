// Editing three.js' shader text.

/** Replaces each chunk where it occurs (its first occurrence only); shaders without a chunk stay as they are. */
export function replaceChunks(source: string, replacements: readonly (readonly [string, string])[]): string {
  return replacements.reduce((text, [chunk, replacement]) => text.replace(chunk, () => replacement), source);
}
