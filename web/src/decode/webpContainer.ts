// The container of WebP files (RFC 9649, section 2), apart from webp.ts, of which what decodes textures needs nothing
// else.

/** Whether the bytes begin as a WebP file does. */
export function isWebp(bytes: Uint8Array): boolean {
  return textAt(bytes, 0) === "RIFF" && textAt(bytes, 8) === "WEBP";
}

/** Four characters, as chunks are named by. */
export function textAt(bytes: Uint8Array, offset: number): string {
  return String.fromCharCode(...bytes.subarray(offset, offset + 4));
}
