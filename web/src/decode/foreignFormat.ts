// Names the format of a file that should be a PNG, for error messages that say how to fix it.

interface Format {
  readonly name: string;
  /** The byte offset of the magic bytes. */
  readonly offset: number;
  /** The magic bytes as text, one character each. */
  readonly magic: string;
}

/** Formats to which hosts and image optimisers convert PNG. */
const formats: readonly Format[] = [
  { name: "a JPEG image", offset: 0, magic: "\xff\xd8\xff" },
  { name: "a WebP image", offset: 8, magic: "WEBP" },
  { name: "an AVIF image", offset: 4, magic: "ftypavif" },
  { name: "a GIF image", offset: 0, magic: "GIF8" },
  { name: "a BMP image", offset: 0, magic: "BM" },
];

/** The name of the format, with its article; undefined for an unknown format. */
export function foreignFormatOf(bytes: Uint8Array): string | undefined {
  const begins = ({ offset, magic }: Format) =>
    Array.from(magic).every((character, index) => bytes[offset + index] === character.charCodeAt(0));
  return formats.find(begins)?.name;
}
