import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { DecodeError } from "./decodeError.ts";
import type { ElementRange } from "./bg/bgArrays.ts";
import { countThatFits, indexArrayOf, vertexArrayOf } from "./bg/bgArrays.ts";
import { byteSizeOf } from "../stage/elementType.ts";
import { trianglesFromStrip } from "./strips.ts";
import { decodeImage } from "./image.ts";
import { checkPng, maxImageEdge } from "./png.ts";
import { chunkOf, joined, pngOf } from "./png.testing.ts";

function refused(kind: DecodeError["kind"]): (error: unknown) => boolean {
  return (error) => error instanceof DecodeError && error.kind === kind;
}

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

describe("an image", () => {
  const png = pngOf({ width: 4, height: 2 });

  test("that decodes to another size than its header states is refused and closed", async () => {
    let closed = 0;
    const wrongImage = {
      width: 2,
      height: 4,
      close: () => {
        closed += 1;
      },
    };
    await assert.rejects(
      decodeImage(png, () => Promise.resolve(wrongImage)),
      refused("malformed"),
    );
    assert.equal(closed, 1);
  });

  test("that the browser cannot decode is malformed", async () => {
    await assert.rejects(
      decodeImage(png, () => Promise.reject(new DOMException("no", "InvalidStateError"))),
      refused("malformed"),
    );
  });

  test("is not passed to the browser if its header is refused", async () => {
    let calls = 0;
    await assert.rejects(
      decodeImage(pngOf({ width: 4, height: 2, colorType: 4 }), () => {
        calls += 1;
        return Promise.reject(new Error("called"));
      }),
      refused("unsupported"),
    );
    assert.equal(calls, 0);
  });
});

describe("a typed array", () => {
  const bytes = Uint8Array.from({ length: 40 }, (_, index) => index);
  const range = (changes: Partial<ElementRange>): ElementRange => ({
    type: "Uint16",
    byteOffset: 0,
    byteStride: 0,
    components: 3,
    count: 0,
    ...changes,
  });

  test("is a view where its elements are aligned, and a copy where they are not", () => {
    const aligned = vertexArrayOf(bytes, range({ byteOffset: 4, byteStride: 8, count: 2 }));
    assert.equal(aligned.stride, 4);
    assert.deepEqual(Array.from(aligned.array.slice(0, 3)), [0x0504, 0x0706, 0x0908]);
    assert.equal(aligned.array.buffer, bytes.buffer);
    const odd = vertexArrayOf(bytes, range({ byteOffset: 5, count: 1 }));
    assert.deepEqual(Array.from(odd.array), [0x0605, 0x0807, 0x0a09]);
  });

  test("that is interleaved with others is a view of the same bytes as theirs", () => {
    const views = [0, 6, 12].map((byteOffset) => vertexArrayOf(bytes, range({ byteOffset, byteStride: 18, count: 2 })));
    assert.deepEqual(
      views.map(({ offset }) => offset),
      [0, 3, 6],
    );
    for (const { array, stride } of views) {
      assert.equal(stride, 9);
      assert.deepEqual([array.buffer, array.byteOffset, array.length], [bytes.buffer, 0, 18]);
    }
    const { array, offset } = vertexArrayOf(
      bytes,
      range({ byteOffset: 18 + 12, byteStride: 18, components: 2, count: 1 }),
    );
    assert.equal(array[offset], 0x1f1e);
    const across = vertexArrayOf(bytes, range({ byteOffset: 14, byteStride: 18, count: 1 }));
    assert.deepEqual([across.offset, across.array[0]], [0, 0x0f0e]);
  });

  test("is completed where the last group lacks its padding", () => {
    const { array, stride } = vertexArrayOf(bytes.slice(0, 14), range({ byteStride: 8 }));
    assert.equal(stride, 4);
    assert.equal(array.length, 8);
    assert.deepEqual(Array.from(array.slice(4)), [0x0908, 0x0b0a, 0x0d0c, 0]);
  });

  test("has as many groups as the bytes hold if the document states no count", () => {
    assert.equal(countThatFits(40, range({})), 6);
    assert.equal(countThatFits(40, range({ byteStride: 8 })), 5);
    assert.equal(countThatFits(38, range({ byteStride: 8 })), 5);
    assert.equal(countThatFits(37, range({ byteStride: 8 })), 4);
    assert.equal(countThatFits(5, range({})), 0);
    assert.equal(countThatFits(40, range({ byteOffset: 100 })), 0);
  });

  test("is refused if the bytes end before the last vertex", () => {
    for (const type of ["Int8", "Uint16", "Float32"] as const) {
      for (const byteStride of [0, 16]) {
        for (const byteOffset of [0, 3, 8, 1000, 2 ** 40]) {
          const groups = range({ type, byteStride, byteOffset });
          const maxCount = countThatFits(bytes.length, groups);
          for (const count of [maxCount + 1, 2 ** 32, 2 ** 52]) {
            assert.throws(() => vertexArrayOf(bytes, { ...groups, count }), refused("truncated"));
          }
          if (maxCount > 0)
            assert.equal(
              vertexArrayOf(bytes, { ...groups, count: maxCount }).array.length %
                Math.max(3, byteStride / byteSizeOf(type)),
              0,
            );
        }
      }
    }
  });

  test("is refused with a stride that splits elements or is shorter than a group", () => {
    for (const byteStride of [7, 4, 1])
      assert.throws(() => vertexArrayOf(bytes, range({ byteStride, count: 1 })), refused("malformed"));
  });

  test("of 32-bit integers becomes floats", () => {
    const { array } = vertexArrayOf(
      new Uint8Array(Uint32Array.from([1, 2 ** 32 - 1, 7]).buffer),
      range({ type: "Uint32" }),
    );
    assert.ok(array instanceof Float32Array);
    assert.deepEqual(Array.from(array), [1, 2 ** 32, 7]);
  });
});

describe("indices", () => {
  const bytes = new Uint8Array(Uint16Array.from([0, 1, 2, 2, 1, 3]).buffer);
  const range: ElementRange = { type: "Uint16", byteOffset: 0, byteStride: 0, components: 1, count: 0 };

  test("are refused if they name vertices that do not exist", () => {
    assert.deepEqual(Array.from(indexArrayOf(bytes, range, 4)), [0, 1, 2, 2, 1, 3]);
    assert.throws(() => indexArrayOf(bytes, range, 3), refused("malformed"));
  });

  test("are refused if they are not unsigned integers", () => {
    for (const type of ["Int8", "Int16", "Int32", "Float32"] as const) {
      assert.throws(() => indexArrayOf(bytes, { ...range, type }, 4), refused("unsupported"));
    }
  });

  test("of a strip become its triangles, with their orientation, and with degenerate ones", () => {
    const strip = Uint16Array.from([0, 1, 2, 3, 3, 4, 4, 5, 6]);
    assert.deepEqual(
      Array.from(trianglesFromStrip(strip)),
      [0, 1, 2, 2, 1, 3, 2, 3, 3, 3, 3, 4, 3, 4, 4, 4, 4, 5, 4, 5, 6],
    );
    assert.equal(trianglesFromStrip(Uint16Array.from([0, 1])).length, 0);
    assert.equal(trianglesFromStrip(new Uint16Array()).length, 0);
  });
});
