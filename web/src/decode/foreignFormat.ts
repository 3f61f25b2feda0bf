// What a file is that should be a PNG: told to people, who can then mend it.

interface Format {
  readonly name: string;
  /** Where the letters stand. */
  readonly offset: number;
  /** Their bytes as text, one character each. */
  readonly magic: string;
}

/** Formats that hosts and image optimisers put in place of a PNG. */
const formats: readonly Format[] = [
  { name: "a JPEG image", offset: 0, magic: "\xff\xd8\xff" },
  { name: "a WebP image", offset: 8, magic: "WEBP" },
  { name: "an AVIF image", offset: 4, magic: "ftypavif" },
  { name: "a GIF image", offset: 0, magic: "GIF8" },
  { name: "a BMP image", offset: 0, magic: "BM" },
];

/** Undefined for what is none of the formats that we know by name. */
export function foreignFormatOf(bytes: Uint8Array): string | undefined {
  const begins = ({ offset, magic }: Format) =>
    Array.from(magic).every((letter, index) => bytes[offset + index] === letter.charCodeAt(0));
  return formats.find(begins)?.name;
}
