// Unpacks zlib and gzip streams whose unpacked length is known beforehand.

import { DecodeError } from "./decodeError.ts";

/** The maximum number of bytes that deflate can encode in one byte. */
export const maxDeflateRatio = 1032;

/**
 * Unpacks a zlib ("deflate") or gzip stream, in pieces, to exactly `length` bytes, and allocates no more. Rejects with
 * DecodeError: also where the checksum differs.
 */
export async function inflate(
  packed: readonly Uint8Array<ArrayBuffer>[],
  length: number,
  format: "deflate" | "gzip" = "deflate",
): Promise<Uint8Array> {
  const bytes = new Uint8Array(length);
  let filled = 0;
  const { writable, readable } = new DecompressionStream(format);
  const reader = readable.getReader();
  feed(writable, packed).catch(() => undefined); // the reader rejects with the same error
  try {
    for (let chunk = await reader.read(); !chunk.done; chunk = await reader.read()) {
      if (filled + chunk.value.length > length) throw new DecodeError("malformed", "holds more than its header states");
      bytes.set(chunk.value, filled);
      filled += chunk.value.length;
    }
  } catch (error) {
    await reader.cancel().catch(() => undefined);
    if (error instanceof DecodeError) throw error;
    throw new DecodeError("malformed", "has a damaged stream of deflate");
  }
  if (filled < length) throw new DecodeError("truncated", "does not hold all that its header states");
  return bytes;
}

async function feed(stream: WritableStream<BufferSource>, chunks: readonly Uint8Array<ArrayBuffer>[]): Promise<void> {
  const writer = stream.getWriter();
  for (const chunk of chunks) await writer.write(chunk);
  await writer.close();
}
