import assert from "node:assert/strict";
import { deflateSync } from "node:zlib";
import { describe, test } from "node:test";
import { TestRandom } from "./compact/rangeEncoder.testing.ts";
import { chunkOf, joined, pngOf } from "./png.testing.ts";
import { pngTexels } from "./pngTexels.ts";

interface TestImage {
  readonly width: number;
  readonly rows: readonly (readonly number[])[];
  readonly type: number;
  readonly depth?: number;
  readonly extra?: readonly Uint8Array<ArrayBuffer>[];
}

/** A PNG with unfiltered rows of bytes. */
function pngWithRows({ width, rows, type, depth = 8, extra = [] }: TestImage): Uint8Array<ArrayBuffer> {
  const header = Buffer.alloc(13);
  header.writeUInt32BE(width, 0);
  header.writeUInt32BE(rows.length, 4);
  header.set([depth, type, 0, 0, 0], 8);
  return joined([
    Uint8Array.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]),
    chunkOf("IHDR", header),
    ...extra,
    chunkOf("IDAT", deflateSync(Uint8Array.from(rows.flatMap((row) => [0, ...row])))),
    chunkOf("IEND", new Uint8Array()),
  ]);
}

const chunk = (type: string, ...bytes: number[]) => chunkOf(type, Uint8Array.from(bytes));
const texelsOf = (bytes: Uint8Array<ArrayBuffer>, { isData = false, maxEdge = 4096 } = {}) =>
  pngTexels({ bytes, isData, maxEdge });

async function assertTexels(image: TestImage, expected: readonly number[]): Promise<void> {
  const texels = await texelsOf(pngWithRows(image));
  assert.deepEqual(texels && { ...texels, data: Array.from(texels.data) }, {
    width: image.width,
    height: image.rows.length,
    data: expected,
  });
}

describe("the texels of a PNG with alpha, the lowest row first", () => {
  test("keep the colours of transparent texels", async () => {
    const rows = [
      [255, 1, 2, 0, 9, 8, 7, 255],
      [3, 4, 5, 1, 6, 7, 8, 128],
    ];
    await assertTexels({ width: 2, rows, type: 6 }, [3, 4, 5, 1, 6, 7, 8, 128, 255, 1, 2, 0, 9, 8, 7, 255]);
  });

  test("are gray with alpha", async () => {
    await assertTexels({ width: 2, rows: [[200, 0, 7, 255]], type: 4 }, [200, 200, 200, 0, 7, 7, 7, 255]);
  });

  test("are transparent where they have the transparent gray or colour", async () => {
    const extra = [chunk("tRNS", 0, 7)];
    await assertTexels({ width: 2, rows: [[7, 8]], type: 0, extra }, [7, 7, 7, 0, 8, 8, 8, 255]);
    await assertTexels({ width: 2, rows: [[1, 2, 3, 1, 2, 4]], type: 2, extra: [chunk("tRNS", 0, 1, 0, 2, 0, 3)] }, [
      ...[1, 2, 3, 0],
      ...[1, 2, 4, 255],
    ]);
    // 0 and 3 of 0 … 3.
    await assertTexels({ width: 2, rows: [[0b00_11_0000]], type: 0, depth: 2, extra: [chunk("tRNS", 0, 3)] }, [
      ...[0, 0, 0, 255],
      ...[255, 255, 255, 0],
    ]);
  });

  for (const [depth, row] of [
    [1, [0b101_00000]],
    [2, [0b01_00_01_00]],
    [4, [0x10, 0x10]],
    [8, [1, 0, 1]],
  ] as const) {
    test(`are looked up in a palette of ${depth} bits with alphas for the first colours`, async () => {
      const extra = [chunk("PLTE", 10, 20, 30, 40, 50, 60), chunk("tRNS", 0)];
      const opaque = [40, 50, 60, 255];
      await assertTexels({ width: 3, rows: [row], type: 3, depth, extra }, [...opaque, 10, 20, 30, 0, ...opaque]);
    });
  }
});

describe("a PNG is left to the browser", () => {
  const rgba = { width: 4, height: 3, colorType: 6 };
  const left: Readonly<Record<string, Uint8Array<ArrayBuffer>>> = {
    "of 16 bits": pngOf({ ...rgba, bitDepth: 16 }),
    interlaced: pngOf({ ...rgba, interlace: 1 }),
    "with an orientation": pngOf({ ...rgba, extra: [chunk("eXIf", 1)] }),
    "that is an animation": pngOf({ ...rgba, extra: [chunk("acTL", 1)] }),
    "of another colour space": pngOf({ ...rgba, extra: [chunk("gAMA", 0, 0, 177, 143)] }),
    "of a colour space that precedes sRGB": pngOf({ ...rgba, extra: [chunk("cICP", 1), chunk("sRGB", 0)] }),
    "with a profile": pngOf({ ...rgba, extra: [chunk("iCCP", 1)] }),
    "whose palette is too short": pngWithRows({ width: 1, rows: [[1]], type: 3, extra: [chunk("PLTE", 1, 2, 3)] }),
    "that ends early": pngOf(rgba).subarray(0, -13),
    "that is none": Uint8Array.from([1, 2, 3]),
  };
  for (const [what, bytes] of Object.entries(left))
    test(what, async () => {
      assert.equal(await texelsOf(bytes), undefined);
    });

  test("with a larger edge than textures have", async () => {
    assert.equal(await texelsOf(pngOf(rgba), { maxEdge: 3 }), undefined);
    assert.equal((await texelsOf(pngOf(rgba), { maxEdge: 4 }))?.data.length, 48);
  });

  test("but not for its colour space where texels are data, or where it is sRGB", async () => {
    const gamma = pngOf({ ...rgba, extra: [chunk("gAMA", 0, 0, 177, 143)] });
    assert.equal((await texelsOf(gamma, { isData: true }))?.width, 4);
    const srgb = pngOf({ ...rgba, extra: [chunk("gAMA", 0, 0, 177, 143), chunk("sRGB", 0)] });
    assert.equal((await texelsOf(srgb))?.width, 4);
  });
});

test("a PNG of random numbers, with right check sums, has all its texels or is left to the browser", async () => {
  const random = new TestRandom(7);
  const bytesOf = (count: number) => Array.from({ length: count }, () => random.below(256));
  let decoded = 0;
  for (let n = 0; n < 500; ++n) {
    const [width, height, type, depth] = [random.below(9), random.below(4), random.below(8), 2 ** random.below(5)];
    const rowLength = Math.ceil((width * ([1, 1, 3, 1, 2, 1, 4][type] ?? 1) * depth) / 8);
    const isWhole = random.below(4) > 0;
    const bytes = pngWithRows({
      width,
      rows: Array.from({ length: height }, () => bytesOf(isWhole ? rowLength : random.below(2 * rowLength + 2))),
      type,
      depth,
      extra: [chunk("PLTE", ...bytesOf(random.below(20))), chunk("tRNS", ...bytesOf(random.below(9)))],
    });
    const texels = await texelsOf(bytes, { maxEdge: 6 });
    if (texels === undefined) continue;
    decoded += 1;
    assert.deepEqual([texels.width, texels.height, texels.data.length], [width, height, 4 * width * height]);
  }
  assert.ok(decoded > 30, `${decoded} decoded`);
});
