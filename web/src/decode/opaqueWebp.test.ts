import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { opaqueWebp } from "./opaqueWebp.ts";

function chunkOf(type: string, ...data: readonly number[]): Buffer {
  const size = Buffer.alloc(4);
  size.writeUInt32LE(data.length);
  return Buffer.concat([Buffer.from(type), size, Buffer.from(data), Buffer.alloc(data.length % 2)]);
}

function webpOf(...chunks: readonly Buffer[]): Uint8Array {
  const size = Buffer.alloc(4);
  size.writeUInt32LE(4 + chunks.reduce((sum, { length }) => sum + length, 0));
  return Uint8Array.from(Buffer.concat([Buffer.from("RIFF"), size, Buffer.from("WEBP"), ...chunks]));
}

const profile = chunkOf("ICCP", 1, 2, 3);
const colors = chunkOf("VP8 ", 4, 5, 6, 7);

describe("a WebP without its alpha", () => {
  test("has all chunks but that of alpha, and no flag of it", () => {
    const file = webpOf(chunkOf("VP8X", 0x30, 0, 0, 0), profile, chunkOf("ALPH", 8, 9, 10), colors);
    assert.deepEqual(opaqueWebp(file), webpOf(chunkOf("VP8X", 0x20, 0, 0, 0), profile, colors));
    const larger = Uint8Array.from([1, 2, 3, ...file]);
    assert.deepEqual(opaqueWebp(larger.subarray(3)), opaqueWebp(file));
    assert.equal(larger[3 + 20], 0x30, "the file stays as it is");
  });

  const none: Readonly<Record<string, Uint8Array>> = {
    "a lossless file": webpOf(chunkOf("VP8L", 0x2f, 0, 0, 0, 0x10)),
    "a lossless file of the extended format": webpOf(chunkOf("VP8X", 0x10), chunkOf("VP8L", 0x2f, 0, 0, 0, 0x10)),
    "an animation": webpOf(chunkOf("VP8X", 0x12, 0, 0, 0), colors),
    "a file that ends early": webpOf(chunkOf("VP8X", 0x10, 0, 0, 0), colors).subarray(0, -1),
    "another format": Uint8Array.from([0x89, 80, 78, 71]),
  };
  for (const [what, bytes] of Object.entries(none))
    test(`is not made of ${what}`, () => {
      assert.equal(opaqueWebp(bytes), undefined);
    });
});
