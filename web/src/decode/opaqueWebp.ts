// Makes lossy WebP files opaque, so that browsers decode the colours of transparent texels (RFC 9649).

import { isWebp, textAt } from "./webpContainer.ts";

const chunksOffset = 12;
/** Bits of the first byte of the chunk VP8X. */
const [alphaFlag, animationFlag] = [0x10, 0x02];

/**
 * The image without its alpha, which lossy files have in a chunk of its own; undefined for lossless ones, animations,
 * malformed files and other formats.
 */
export function opaqueWebp(bytes: Uint8Array): Uint8Array<ArrayBuffer> | undefined {
  if (!isWebp(bytes)) return undefined;
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const chunks: Uint8Array[] = [];
  for (let at = chunksOffset; at + 8 <= bytes.length;) {
    const size = view.getUint32(at + 4, true);
    if (at + 8 + size > bytes.length) return undefined;
    const chunk = bytes.slice(at, at + 8 + size + (size % 2));
    at += chunk.length;
    const type = textAt(chunk, 0);
    const flags = chunk[8] ?? 0;
    if (type === "VP8L" || (type === "VP8X" && (flags & animationFlag) !== 0)) return undefined;
    if (type === "VP8X") chunk[8] = flags & ~alphaFlag;
    if (type !== "ALPH") chunks.push(chunk);
  }
  const file = new Uint8Array(chunks.reduce((sum, { length }) => sum + length, chunksOffset));
  file.set(bytes.subarray(0, chunksOffset));
  new DataView(file.buffer).setUint32(4, file.length - 8, true);
  let at = chunksOffset;
  for (const chunk of chunks) {
    file.set(chunk, at);
    at += chunk.length;
  }
  return file;
}
