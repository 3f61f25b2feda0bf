import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, test } from "node:test";
import { crc32 } from "node:zlib";
import { TestRandom } from "./compact/rangeEncoder.testing.ts";
import { DecodeError } from "./decodeError.ts";
import { decodeWebpPixels } from "./webpPixels.ts";

const folder = join(import.meta.dirname, "../../../vectors/webp");

interface Verdict {
  readonly width: number;
  readonly height: number;
  /** The checksum of the pixels that libwebp decodes. */
  readonly crc32?: string;
}

const verdicts = JSON.parse(readFileSync(join(folder, "verdicts.json"), "utf8")) as Record<string, Verdict>;
const images = Object.entries(verdicts).filter(([, verdict]) => verdict.crc32 !== undefined);
const bytesOf = (name: string) => new Uint8Array(readFileSync(join(folder, name)));

/** Decodes a file that may be damaged; false where it is refused. */
function isDecoded(bytes: Uint8Array<ArrayBuffer>): boolean {
  try {
    const { width, height, data } = decodeWebpPixels(bytes, 64);
    assert.equal(data.length, 4 * width * height);
    return true;
  } catch (error) {
    if (error instanceof DecodeError) return false;
    throw error;
  }
}

describe("lossless WebP", () => {
  for (const [name, { width, height, crc32: checksum }] of images)
    test(`decodes to every byte that libwebp decodes: ${name}`, () => {
      const pixels = decodeWebpPixels(bytesOf(name));
      assert.deepEqual([pixels.width, pixels.height, pixels.channels], [width, height, 4]);
      assert.equal(crc32(pixels.data).toString(16).padStart(8, "0"), checksum);
    });

  test("is decoded whole or refused where its bits are damaged", () => {
    assert.equal(images.length, 4);
    const random = new TestRandom(3);
    let [decoded, refused] = [0, 0];
    for (const [name] of images)
      for (let n = 0; n < 1000; ++n) {
        const bytes = bytesOf(name);
        for (let damage = random.below(4); damage >= 0; --damage)
          bytes[25 + random.below(bytes.length - 25)] = random.below(256); // after the header
        if (isDecoded(bytes)) decoded += 1;
        else refused += 1;
      }
    assert.ok(decoded > 100 && refused > 100, `${decoded} decoded, ${refused} refused`);
  });

  test("is refused where its bits end early", () => {
    const bytes = bytesOf("rgba.webp");
    const sizes = new DataView(bytes.buffer);
    for (let length = bytes.length - 2; length >= 26; length -= 2) {
      sizes.setUint32(4, length - 8, true);
      sizes.setUint32(16, length - 20, true);
      assert.throws(() => decodeWebpPixels(bytes.slice(0, length)), DecodeError, `${length} bytes`);
    }
  });
});
