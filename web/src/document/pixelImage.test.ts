import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { crc32, inflateSync } from "node:zlib";
import { shapesOf } from "./description.ts";
import { elementsOf } from "./elements.testing.ts";
import { pixelImageOf, pngOfPixels } from "./pixelImage.ts";
import { readScene } from "./readScene.ts";

/** Decodes an 8-bit PNG without filters by independent code. */
function contentOf(png: Uint8Array): { width: number; height: number; colorType: number; rows: number[][] } {
  const bytes = Buffer.from(png);
  const data: Buffer[] = [];
  for (let chunk = 8; chunk < bytes.length;) {
    const length = bytes.readUInt32BE(chunk);
    const end = chunk + 8 + length;
    assert.equal(bytes.readUInt32BE(end), crc32(bytes.subarray(chunk + 4, end)));
    if (bytes.toString("latin1", chunk + 4, chunk + 8) === "IDAT") data.push(bytes.subarray(chunk + 8, end));
    chunk = end + 4;
  }
  const [width, height] = [bytes.readUInt32BE(16), bytes.readUInt32BE(20)];
  const all = inflateSync(Buffer.concat(data)); // checks the Adler-32 checksum
  const stride = all.length / height;
  const rows = Array.from({ length: height }, (_, row) => Array.from(all.subarray(row * stride, (row + 1) * stride)));
  assert.ok(rows.every(([filter]) => filter === 0));
  return { width, height, colorType: bytes[25] ?? -1, rows: rows.map((row) => row.slice(1)) };
}

function pngOf(...numbers: number[]): ReturnType<typeof contentOf> {
  const image = pixelImageOf(numbers);
  assert.ok(image);
  return contentOf(pngOfPixels(image));
}

function texturesIn(markup: string): { urls: string[]; warnings: string[] } {
  const { root, warnings } = readScene(
    elementsOf(`<X3D><Scene><Shape><Appearance>${markup}</Appearance></Shape></Scene></X3D>`),
  );
  return {
    urls: shapesOf(root).flatMap(({ appearance }) =>
      appearance.textures.map(({ role, urls }) => `${role} ${urls.join(" ")}`),
    ),
    warnings: warnings.map(({ message }) => message),
  };
}

describe("pixel images", () => {
  test("become PNGs with the same channels and flipped rows", () => {
    assert.deepEqual(pngOf(1, 2, 1, 7, 0xfe), { width: 1, height: 2, colorType: 0, rows: [[0xfe], [7]] });
    assert.deepEqual(pngOf(2, 1, 2, 0x12f0, 3), { width: 2, height: 1, colorType: 4, rows: [[0x12, 0xf0, 0, 3]] });
    assert.deepEqual(pngOf(1, 2, 3, 0xff8040, 1), {
      width: 1,
      height: 2,
      colorType: 2,
      rows: [
        [0, 0, 1],
        [0xff, 0x80, 0x40],
      ],
    });
    assert.deepEqual(pngOf(1, 1, 4, 0xfedcba98), {
      width: 1,
      height: 1,
      colorType: 6,
      rows: [[0xfe, 0xdc, 0xba, 0x98]],
    });
  });

  test("may be larger than one stored block of deflate", () => {
    const pixels = Array.from({ length: 300 * 250 }, (_, i) => i % 256);
    const { rows } = pngOf(300, 250, 1, ...pixels);
    assert.deepEqual(rows.toReversed().flat(), pixels);
  });

  test("are refused for missing, surplus or too large numbers and for impossible sizes", () => {
    for (const numbers of [
      [],
      [1, 1],
      [1, 1, 3],
      [1, 1, 3, 0, 0],
      [1, 1, 1, 256],
      [1, 1, 1, -1],
      [1, 1, 1, 0.5],
      [1, 1, 5, 0],
      [-1, -1, 1, 0],
      [1e9, 1e9, 4, 0],
      [0.5, 2, 1, 0],
      [16385, 1, 1, ...new Array<number>(16385).fill(0)],
    ]) {
      assert.equal(pixelImageOf(numbers), undefined, String(numbers.slice(0, 5)));
    }
    assert.deepEqual(pixelImageOf([0, 0, 0])?.pixels, []);
  });

  test("become textures; a malformed image raises a warning and gives no texture", () => {
    const pixel = '<PixelTexture image="1 1 3 0xff0000"/>';
    const {
      urls: [plain],
    } = texturesIn(`<Material/>${pixel}`);
    assert.match(plain ?? "", /^color data:image\/png;base64,/);
    assert.deepEqual(texturesIn(`<Material/><MultiTexture>${pixel}<ImageTexture url="b.png"/></MultiTexture>`).urls, [
      plain,
    ]);
    const {
      urls: [emissive],
    } = texturesIn('<Material><PixelTexture containerField="emissiveTexture" image="1 1 3 0xff0000"/></Material>');
    assert.equal(emissive, plain?.replace("color", "emissive"));
    const wrong = texturesIn('<Material/><PixelTexture image="2 2 3 0xff0000"/>');
    assert.deepEqual(wrong.urls, []);
    assert.match(wrong.warnings[0] ?? "", /is no SFImage/);
    assert.deepEqual(texturesIn("<Material/><PixelTexture/>"), { urls: [], warnings: [] });
  });
});
