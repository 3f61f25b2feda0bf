// The GPU memory that the meshes with levels of detail of a scene take at most, whatever the page allows, and that of
// their vertices.

const mebibyte = 2 ** 20;

/** In bytes. Phones and tablets, which have a touchscreen and nothing that hovers, share less memory among all pages. */
export function maxMeshBytesOf(media: ((query: string) => { readonly matches: boolean }) | undefined): number {
  return media?.("(pointer: coarse) and (hover: none)").matches === true ? 96 * mebibyte : 256 * mebibyte;
}

/** GPU memory of all meshes of a scene together, on this device. */
export const maxMeshBytes = maxMeshBytesOf((globalThis as Partial<typeof globalThis>).matchMedia?.bind(globalThis));

/** GPU memory of a vertex until one has been stored: 8 bytes of coordinates, 4 of the normal. */
export const expectedBytesPerVertex = 12;
