// The GPU memory that the meshes with levels of detail of a scene take at most, whatever the page allows.

const mebibyte = 2 ** 20;

/** In bytes. Phones and tablets, which have a touchscreen and nothing that hovers, share less memory among all pages. */
export function maxMeshBytesOf(media: ((query: string) => { readonly matches: boolean }) | undefined): number {
  return media?.("(pointer: coarse) and (hover: none)").matches === true ? 96 * mebibyte : 256 * mebibyte;
}
