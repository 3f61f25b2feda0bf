import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { byteSizeOf } from "../../stage/elementType.ts";
import { refused } from "../decodeError.testing.ts";
import type { ElementRange } from "./bgArrays.ts";
import { countThatFits, indexArrayOf, vertexArrayOf } from "./bgArrays.ts";

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
});
