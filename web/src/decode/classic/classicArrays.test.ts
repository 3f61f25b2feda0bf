import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { classicColors, classicCoords, classicIndex, classicNormals } from "./classicArrays.ts";
import { pngWithTexels } from "../png.testing.ts";

/** An RGB image of 4 x 2 texels, whose bytes begin with `first`. */
const plane = (first: number) => pngWithTexels(4, 2, 3, (n, channel) => (first + 10 * n + channel) % 256);
const file = (png: Uint8Array<ArrayBuffer>, firstTexel = 0) => ({ bytes: png, firstTexel });
const layout = { count: 5, rowLength: 0 };

describe("coordinates on the CPU", () => {
  test("are combined from their byte planes, the most significant first", async () => {
    const coord = await classicCoords({
      ...layout,
      planes: [file(plane(1)), file(plane(101))],
      planeCount: 2,
      missingBytesMidpoint: 0,
    });
    assert.ok(coord.array instanceof Uint16Array);
    assert.deepEqual([coord.components, coord.stride], [3, 4]);
    assert.deepEqual(Array.from(coord.array.subarray(4, 7)), [11 * 256 + 111, 12 * 256 + 112, 13 * 256 + 113]);
    assert.equal(coord.array.length, 20);
  });

  test("have the midpoint in place of missing bytes, and the exact sum of three bytes", async () => {
    const coarse = await classicCoords({
      ...layout,
      planes: [file(plane(1))],
      planeCount: 2,
      missingBytesMidpoint: 127.5,
    });
    assert.deepEqual(Array.from(coarse.array.subarray(0, 3)), [383.5, 639.5, 895.5]);
    const fine = await classicCoords({
      ...layout,
      planes: [1, 2, 3].map((n) => file(plane(n))),
      planeCount: 3,
      missingBytesMidpoint: 0,
    });
    assert.deepEqual(Array.from(fine.array.subarray(0, 3)), [0x010203, 0x020304, 0x030405]);
    const byte = await classicCoords({ ...layout, planes: [file(plane(7))], planeCount: 1, missingBytesMidpoint: 0 });
    assert.deepEqual([byte.array.constructor, byte.array[4]], [Uint8Array, 17]);
  });

  test("are read from the first texel of the reference on, and in rows of `rowLength` where it is not 0", async () => {
    const shifted = await classicCoords({
      count: 3,
      rowLength: 0,
      planes: [file(plane(0), 2)],
      planeCount: 1,
      missingBytesMidpoint: 0,
    });
    assert.deepEqual(
      [0, 4, 8].map((at) => shifted.array[at]),
      [20, 30, 40],
    );
    const rows = await classicCoords({
      count: 4,
      rowLength: 3,
      planes: [file(plane(0))],
      planeCount: 1,
      missingBytesMidpoint: 0,
    });
    assert.deepEqual(
      [0, 4, 8, 12].map((at) => rows.array[at]),
      [0, 10, 20, 40],
    );
  });

  test("are refused where there are more records than texels", async () => {
    for (const [count, rowLength, first] of [
      [9, 0, 0],
      [7, 0, 2],
      [7, 3, 0],
      [2, 5, 0],
    ] as const) {
      const job = { count, rowLength, planes: [file(plane(0), first)], planeCount: 1, missingBytesMidpoint: 0 };
      await assert.rejects(classicCoords(job), { name: "DecodeError", kind: "malformed" });
    }
    const gray = pngWithTexels(4, 2, 1, () => 0);
    await assert.rejects(classicCoords({ ...layout, planes: [file(gray)], planeCount: 1, missingBytesMidpoint: 0 }), {
      message: /1 channels where 3/,
    });
  });
});

describe("an index on the CPU", () => {
  /** An index image that names records by column and row of a coordinate image of 64 x 32 texels. */
  const indexImageOf = (records: readonly number[]) =>
    pngWithTexels(records.length, 1, 3, (n, channel) => {
      const record = records[n] ?? 0;
      return [(record % 64) * 4, Math.floor(record / 64) * 8, 0][channel] ?? 0;
    });
  const job = { rowLength: 8, isWide: false, coordWidth: 64, coordHeight: 32, recordCount: 2048, ccw: true };
  const triangles = [{ primitive: "triangles", first: 0, count: 6 }] as const;

  test("names records by column and row in 256ths of the image", async () => {
    const { index, draws } = await classicIndex({
      ...job,
      file: file(indexImageOf([0, 63, 64, 2047, 1000, 5, 0, 0])),
      draws: triangles,
    });
    assert.deepEqual([index, draws], [Uint16Array.from([0, 63, 64, 2047, 1000, 5]), triangles]);
  });

  test("names records by index where it has three bytes", async () => {
    const wide = pngWithTexels(8, 1, 3, (n, channel) => [7, n, 1][channel] ?? 0);
    const { index } = await classicIndex({
      ...job,
      isWide: true,
      recordCount: 70_000,
      file: file(wide),
      draws: triangles,
    });
    assert.deepEqual(
      index,
      Uint32Array.from([0, 1, 2, 3, 4, 5], (n) => 65_536 + 256 * n + 7),
    );
  });

  test("converts strips to triangles", async () => {
    const { index, draws } = await classicIndex({
      ...job,
      file: file(indexImageOf([0, 1, 2, 3, 9, 8, 7, 0])),
      draws: [
        { primitive: "triangleStrip", first: 0, count: 4 },
        { primitive: "triangles", first: 4, count: 3 },
      ],
    });
    assert.deepEqual(Array.from(index), [0, 1, 2, 2, 1, 3, 9, 8, 7]);
    assert.deepEqual(draws, [
      { primitive: "triangles", first: 0, count: 6 },
      { primitive: "triangles", first: 6, count: 3 },
    ]);
  });

  test("is refused where it names a record that does not exist", async () => {
    const bad = { ...job, recordCount: 1000, file: file(indexImageOf([0, 1, 2, 3, 1000, 5, 0, 0])), draws: triangles };
    await assert.rejects(classicIndex(bad), { kind: "malformed", message: /index 1000 where there are 1000/ });
  });
});

test("normals on the CPU are the bytes of vectors, or pairs from both halves of the image", async () => {
  const vectors = await classicNormals({ ...layout, file: file(plane(3)), format: { kind: "byteVector" } });
  assert.deepEqual([vectors.components, Array.from(vectors.array.subarray(4, 7))], [3, [13, 14, 15]]);
  const pairs = await classicNormals({
    ...layout,
    count: 3,
    file: file(
      pngWithTexels(4, 2, 1, (n) => n),
      1,
    ),
    format: { kind: "octahedral", bits: 8 },
  });
  assert.deepEqual([pairs.components, Array.from(pairs.array)], [2, [1, 5, 0, 0, 2, 6, 0, 0, 3, 7, 0, 0]]);
  await assert.rejects(
    classicNormals({ ...layout, file: file(pngWithTexels(4, 2, 1, (n) => n)), format: { kind: "spherical", bits: 8 } }),
    { kind: "malformed" },
  );
});

test("colours on the CPU keep three or four components", async () => {
  const rgba = pngWithTexels(5, 1, 4, (n, channel) => 10 * n + channel);
  for (const components of [3, 4] as const) {
    const colors = await classicColors({ ...layout, file: file(rgba), components });
    assert.deepEqual(
      [colors.components, Array.from(colors.array.subarray(4, 8))],
      [components, [10, 11, 12, components === 4 ? 13 : 0]],
    );
  }
});
