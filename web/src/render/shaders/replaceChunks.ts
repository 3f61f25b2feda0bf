// Edits the text of three.js' shaders.

/** Replaces the first occurrence of each chunk. Chunks that the shader does not contain are skipped. */
export function replaceChunks(source: string, replacements: readonly (readonly [string, string])[]): string {
  return replacements.reduce((text, [chunk, replacement]) => text.replace(chunk, () => replacement), source);
}
