/** Not every pass has every chunk; `begin_vertex` they all have. */
export function replaceChunks(source: string, replacements: readonly (readonly [string, string])[]): string {
  return replacements.reduce((text, [chunk, replacement]) => text.replace(chunk, () => replacement), source);
}
