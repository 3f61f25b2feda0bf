import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { DecodeError } from "./decodeError.ts";
import { refused } from "./decodeError.testing.ts";
import { checkPng, maxImageEdge } from "./png.ts";
import { chunkOf, joined, pngOf } from "./png.testing.ts";

describe("a PNG", () => {
  test("of 8-bit gray, RGB, palette or RGBA has the size and channels of its header", () => {
    assert.deepEqual(checkPng(pngOf({ width: 256, height: 3 })), { width: 256, height: 3, channels: 3 });
    assert.deepEqual(checkPng(pngOf({ width: 2, height: 9, colorType: 0 })), { width: 2, height: 9, channels: 1 });
    assert.deepEqual(checkPng(pngOf({ width: 2, height: 9, colorType: 3 })), { width: 2, height: 9, channels: 3 });
    assert.deepEqual(checkPng(pngOf({ width: 1, height: 1, colorType: 6 })), { width: 1, height: 1, channels: 4 });
  });

  test("may be anywhere in a larger buffer", () => {
    const png = pngOf({ width: 5, height: 7 });
    assert.deepEqual(checkPng(joined([new Uint8Array(3), png]).subarray(3)), { width: 5, height: 7, channels: 3 });
  });

  test("with further chunks is accepted", () => {
    assert.deepEqual(checkPng(pngOf({ width: 2, height: 2, extra: [chunkOf("tEXt", new Uint8Array(9))] })), {
      width: 2,
      height: 2,
      channels: 3,
    });
  });

  for (const type of ["ABCD", "IHDR", "IDAT"]) {
    test(`with ${type === "IDAT" ? "image data in separate runs" : `another ${type} chunk`} is malformed`, () => {
      const extra = [chunkOf(type, new Uint8Array(3)), chunkOf("tEXt", new Uint8Array(3))];
      assert.throws(() => checkPng(pngOf({ width: 2, height: 2, extra })), refused("malformed"));
    });
  }

  for (const [what, png] of Object.entries({
    "a transparent palette": pngOf({ width: 2, height: 2, colorType: 3, extra: [chunkOf("tRNS", new Uint8Array(1))] }),
    "gray with alpha": pngOf({ width: 2, height: 2, colorType: 4 }),
    "16 bits a channel": pngOf({ width: 2, height: 2, bitDepth: 16 }),
    interlacing: pngOf({ width: 2, height: 2, interlace: 1 }),
  })) {
    test(`with ${what} is refused as unsupported`, () => {
      assert.throws(() => checkPng(png), refused("unsupported"));
    });
  }

  for (const [width, height] of [
    [0, 1],
    [1, 0],
    [maxImageEdge + 1, 1],
    [1, 2 ** 31],
  ] as const) {
    test(`of ${width} x ${height} texels is beyond the limit`, () => {
      assert.throws(() => checkPng(pngOf({ width, height: Math.min(height, 2 ** 31) })), refused("limit"));
    });
  }

  test("is refused if it is cut anywhere, or if bytes follow it", () => {
    const png = pngOf({ width: 16, height: 4 });
    for (let length = 0; length < png.length; ++length) {
      assert.throws(() => checkPng(png.subarray(0, length)), DecodeError, `prefix of ${length} bytes`);
    }
    assert.throws(() => checkPng(joined([png, new Uint8Array(1)])), refused("malformed"));
  });

  test("with any byte changed is refused or stays within the limits", () => {
    const png = pngOf({ width: 16, height: 4 });
    for (let byteOffset = 0; byteOffset < png.length; ++byteOffset) {
      for (const bits of [1, 0x80, 0xff]) {
        const changed = png.slice();
        changed[byteOffset] = (changed[byteOffset] ?? 0) ^ bits;
        try {
          const { width, height } = checkPng(changed);
          assert.ok(width >= 1 && height >= 1 && width <= maxImageEdge && height <= maxImageEdge);
        } catch (error) {
          assert.ok(error instanceof DecodeError, String(error));
        }
      }
    }
  });

  test("is refused if the bytes are of another format", () => {
    assert.throws(() => checkPng(new TextEncoder().encode("<!DOCTYPE html><title>404</title>")), refused("malformed"));
  });

  for (const [name, head] of Object.entries({
    "a JPEG": [0xff, 0xd8, 0xff, 0xe0, 0, 16, 0x4a, 0x46, 0x49, 0x46],
    "a WebP": [...Buffer.from("RIFF\x10\0\0\0WEBPVP8 ")],
    "an AVIF": [...Buffer.from("\0\0\0\x20ftypavif")],
    "a GIF": [...Buffer.from("GIF89a")],
  })) {
    test(`that is ${name} is refused with the name of that format`, () => {
      assert.throws(
        () => checkPng(Uint8Array.from(head)),
        (error) =>
          error instanceof DecodeError && error.kind === "unsupported" && error.message.startsWith(`is ${name} image`),
      );
    });
  }
});
