import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, test } from "node:test";
import { chunkOf, pngOf } from "./png.testing.ts";
import { mayHaveAlpha } from "./textureImage.ts";

const folder = join(import.meta.dirname, "../../../vectors/webp");

function webp(name: string): Uint8Array {
  return new Uint8Array(readFileSync(join(folder, `${name}.webp`)));
}

/** The beginning of a WebP of the extended format with these flags. */
function extendedWebp(flags: number): Uint8Array {
  const bytes = new Uint8Array(30);
  bytes.set(Buffer.from("RIFF\x16\0\0\0WEBPVP8X\x0a\0\0\0", "latin1"));
  bytes[20] = flags;
  return bytes;
}

describe("an image may have transparent texels", () => {
  test("if it is a PNG with alpha or a transparent colour", () => {
    const size = { width: 2, height: 2 };
    const transparent = chunkOf("tRNS", new Uint8Array(6));
    assert.deepEqual(
      [0, 2, 4, 6].map((colorType) => mayHaveAlpha(pngOf({ ...size, colorType }))),
      [false, false, true, true],
    );
    assert.ok(mayHaveAlpha(pngOf({ ...size, extra: [transparent] })));
  });

  test("if it is a lossless WebP that uses alpha, not if all its texels are opaque", () => {
    assert.deepEqual(
      ["rgba", "rgb", "gray", "palette"].map((name) => mayHaveAlpha(webp(name))),
      [true, false, false, false],
    );
  });

  test("if the flags of a WebP of the extended format say so, never in lossy ones of the simple format", () => {
    const [alphaFlag, otherFlags] = [0x10, 0x2c];
    assert.deepEqual(
      [alphaFlag, otherFlags, 0].map((flags) => mayHaveAlpha(extendedWebp(flags))),
      [true, false, false],
    );
    assert.equal(mayHaveAlpha(webp("lossy")), false);
  });

  test("never if it is a JPEG, always in other formats", () => {
    assert.equal(mayHaveAlpha(Uint8Array.of(0xff, 0xd8, 0xff, 0xe0)), false);
    assert.ok(mayHaveAlpha(Buffer.from("GIF89a", "latin1")));
  });
});
