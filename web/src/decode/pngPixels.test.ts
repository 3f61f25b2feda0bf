import assert from "node:assert/strict";
import { deflateSync } from "node:zlib";
import { describe, test } from "node:test";
import { DecodeError } from "./decodeError.ts";
import { chunkOf, joined } from "./png.testing.ts";
import { decodePixels } from "./pngPixels.ts";

interface Sample {
  readonly width: number;
  readonly height: number;
  readonly channels: 1 | 3 | 4;
  readonly texels: Uint8Array<ArrayBuffer>;
}

function sampleOf(width: number, height: number, channels: 1 | 3 | 4): Sample {
  return {
    width,
    height,
    channels,
    texels: Uint8Array.from({ length: width * height * channels }, (_, n) => (n * 2654435761) >>> 23),
  };
}

/** Applies the filters of the specification, by its formulas. */
function filtered(
  { width, height, channels, texels }: Sample,
  filterOf: (row: number) => number,
): Uint8Array<ArrayBuffer> {
  const length = width * channels;
  const byte = (row: number, n: number) => (row < 0 || n < 0 ? 0 : (texels[row * length + n] ?? 0));
  const bytes: number[] = [];
  for (let row = 0; row < height; ++row) {
    const filter = filterOf(row);
    bytes.push(filter);
    for (let n = 0; n < length; ++n) {
      const [a, b, c] = [byte(row, n - channels), byte(row - 1, n), n < channels ? 0 : byte(row - 1, n - channels)];
      const p = a + b - c;
      const nearest = [a, b, c].reduce((best, guess) => (Math.abs(p - guess) < Math.abs(p - best) ? guess : best), a);
      bytes.push((byte(row, n) - ([0, a, b, Math.floor((a + b) / 2), nearest][filter] ?? 0)) & 255);
    }
  }
  return Uint8Array.from(bytes);
}

/** A PNG whose image data is `data`, deflated. */
function pngWith(
  sample: Sample,
  data: Uint8Array,
  { colorType = { 1: 0, 3: 2, 4: 6 }[sample.channels], extra = [] as Uint8Array[], chunkCount = 1, level = 6 } = {},
) {
  const header = Buffer.alloc(13);
  header.writeUInt32BE(sample.width, 0);
  header.writeUInt32BE(sample.height, 4);
  header.set([8, colorType, 0, 0, 0], 8);
  const packed = deflateSync(data, { level });
  const size = Math.ceil(packed.length / chunkCount);
  return joined([
    Uint8Array.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]),
    chunkOf("IHDR", header),
    ...extra,
    ...Array.from({ length: chunkCount }, (_, n) => chunkOf("IDAT", packed.subarray(n * size, (n + 1) * size))),
    chunkOf("IEND", new Uint8Array()),
  ]);
}

describe("the texels of a PNG", () => {
  for (const channels of [1, 3, 4] as const) {
    test(`of ${channels} channels are decoded from every filter, and from all filters mixed`, async () => {
      const sample = sampleOf(23, 11, channels);
      for (const filterOf of [...[0, 1, 2, 3, 4].map((filter) => () => filter), (row: number) => row % 5]) {
        const pixels = await decodePixels(pngWith(sample, filtered(sample, filterOf)));
        assert.deepEqual(pixels, { width: 23, height: 11, channels, data: sample.texels });
      }
    });
  }

  test("may be in several chunks, and in a view of a larger buffer", async () => {
    const sample = sampleOf(9, 5, 3);
    const png = pngWith(
      sample,
      filtered(sample, () => 4),
      { chunkCount: 3 },
    );
    const larger = joined([new Uint8Array(7), png, new Uint8Array(5)]);
    assert.deepEqual((await decodePixels(larger.subarray(7, 7 + png.length))).data, sample.texels);
  });

  test("are looked up in the palette", async () => {
    const numbers: Sample = { width: 4, height: 1, channels: 1, texels: Uint8Array.from([0, 2, 1, 2]) };
    const palette = chunkOf("PLTE", Uint8Array.from([1, 2, 3, 4, 5, 6, 7, 8, 9]));
    const png = (texels: number[]) =>
      pngWith(
        numbers,
        filtered({ ...numbers, texels: Uint8Array.from(texels) }, () => 0),
        { colorType: 3, extra: [palette] },
      );
    const { data, channels } = await decodePixels(png([0, 2, 1, 2]));
    assert.deepEqual([channels, Array.from(data)], [3, [1, 2, 3, 7, 8, 9, 4, 5, 6, 7, 8, 9]]);
    await assert.rejects(decodePixels(png([0, 3, 1, 2])), { message: /colour that its palette does not have/ });
    await assert.rejects(
      decodePixels(
        pngWith(
          numbers,
          filtered(numbers, () => 0),
          { colorType: 3 },
        ),
      ),
      { message: /no palette/ },
    );
  });

  const sample = sampleOf(6, 4, 3);
  const whole = filtered(sample, () => 1);
  for (const [what, data] of [
    ["too few bytes", whole.subarray(0, whole.length - 1)],
    ["too many bytes", joined([whole, Uint8Array.from([0])])],
    ["rows with an unknown filter", joined([Uint8Array.from([5]), whole.subarray(1)])],
  ] as const) {
    test(`are refused if there are ${what}`, async () => {
      await assert.rejects(decodePixels(pngWith(sample, data)), (error) => error instanceof DecodeError);
    });
  }

  for (const [how, level] of [
    ["deflated", 6],
    ["stored", 0],
  ] as const) {
    test(`${how} are refused, or decoded to the same bytes, whichever byte of the stream is changed`, async () => {
      const png = pngWith(sample, whole, { level });
      assert.deepEqual((await decodePixels(png)).data, sample.texels);
      const begin = Buffer.from(png).indexOf("IDAT") + 4;
      const length = Buffer.from(png).indexOf("IEND") - 8 - begin;
      for (let at = 0; at < length; ++at) {
        const changed = png.slice(begin, begin + length);
        changed[at] = (changed[at] ?? 0) ^ 0x41;
        // The chunk has a valid CRC, so that the decoder of the stream must detect the damage.
        const outcome = await decodePixels(
          joined([png.subarray(0, begin - 8), chunkOf("IDAT", changed), png.subarray(begin + length + 4)]),
        ).catch((error: unknown) => error);
        if (!(outcome instanceof DecodeError))
          assert.deepEqual((outcome as { data: Uint8Array }).data, sample.texels, `byte ${at}`);
      }
    });
  }

  test("stored in several blocks are decoded", async () => {
    const large = sampleOf(300, 250, 1);
    assert.deepEqual(
      (
        await decodePixels(
          pngWith(
            large,
            filtered(large, () => 0),
            { level: 0 },
          ),
        )
      ).data,
      large.texels,
    );
  });
});
