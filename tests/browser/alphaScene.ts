// A page of textures with alpha whose colours are displayed whatever their alpha is: of every way in which the runtime
// decodes them. And what makes Chromium lose colours, as Safari does.

import assert from "node:assert/strict";
import { mkdirSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { deflateSync } from "node:zlib";
import { chunkOf, joined } from "../../web/src/decode/png.testing.ts";
import { outputDirectory, repository } from "./paths.ts";
import { encodePng, type Picture } from "./png.ts";
import { sceneOf } from "./scenes.ts";
import { siteOf, siteOfGenerated } from "./sites.ts";

const alphas = [0, 1, 40, 255, 128, 254, 0, 77];
/** Rows differ, and so do columns. */
const picture: Picture = {
  width: 4,
  height: 2,
  channels: 4,
  data: Uint8Array.from(alphas.flatMap((alpha, n) => [255 - 30 * n, 40 * (n % 4) + 60, 200 - 90 * (n >> 2), alpha])),
};
const grays: Picture = {
  ...picture,
  channels: 2,
  data: Uint8Array.from(alphas.flatMap((alpha, n) => [250 - 30 * n, alpha])),
};

/** A PNG after whose header there are further chunks. */
function withChunks(png: Buffer, ...chunks: readonly Uint8Array[]): Uint8Array {
  const headerEnd = 33;
  return joined([png.subarray(0, headerEnd), ...chunks, png.subarray(headerEnd)]);
}

/** A PNG of 16 bits whose lower bytes are those of rounding. */
function deepPng({ width, height, data }: Picture, ...chunks: readonly Uint8Array[]): Uint8Array {
  const header = Buffer.alloc(13);
  header.writeUInt32BE(width, 0);
  header.writeUInt32BE(height, 4);
  header.set([16, 6, 0, 0, 0], 8);
  const rows = Array.from({ length: height }, (_, row) => [
    0,
    ...Array.from(data.subarray(row * width * 4, (row + 1) * width * 4)).flatMap((byte) => [byte, byte]),
  ]);
  return joined([
    Uint8Array.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]),
    chunkOf("IHDR", header),
    ...chunks,
    chunkOf("IDAT", deflateSync(Uint8Array.from(rows.flat()))),
    chunkOf("IEND", new Uint8Array()),
  ]);
}

/** The gamma of a picture with brighter colours than sRGB. */
const gamma = chunkOf("gAMA", Uint8Array.from([0, 0, 0x88, 0xb8])); // 0.35

/** A disc with a soft edge in colours that go on beyond it. */
function softPng(): Buffer {
  const [width, height] = [96, 64];
  const texels = Array.from({ length: width * height }, (_, n) => {
    const [x, y] = [n % width, Math.floor(n / width)];
    const alpha = (x - 48) ** 2 + (y - 32) ** 2 < 600 ? 255 - ((x + y) % 40) : 0;
    return [60 + 2 * x, 200 - 2 * y, 60 + x, alpha];
  });
  return encodePng({ width, height, channels: 4, data: Uint8Array.from(texels.flat()) });
}

/** The disc in a format of `convert --textures`. */
function softImage(format: "webp" | "avif"): Buffer {
  const folder = join(outputDirectory, "alpha-source");
  mkdirSync(folder, { recursive: true });
  writeFileSync(join(folder, "soft.png"), softPng());
  const scene = join(folder, "soft.x3d");
  const shape = '<Shape><Appearance><ImageTexture url="soft.png"/></Appearance><Box/></Shape>';
  writeFileSync(scene, `<X3D><Scene>${shape}</Scene></X3D>`);
  const textures = join(siteOf(scene, "--textures", format, "--no-pictures"), "textures");
  const name = readdirSync(textures).find((name) => name.endsWith(format));
  assert.ok(name);
  return readFileSync(join(textures, name));
}

export const files = {
  "rgba.png": encodePng(picture),
  "gray.png": encodePng(grays),
  "deep.png": deepPng(picture),
  "gamma.png": withChunks(encodePng(picture), gamma),
  "deep-gamma.png": deepPng(picture, gamma),
  "soft.webp": softImage("webp"),
  "soft.avif": softImage("avif"),
  "lossless.webp": readFileSync(join(repository, "vectors/webp/rgba.webp")),
} as const;

const properties =
  '<TextureProperties boundaryModeS="CLAMP_TO_EDGE" boundaryModeT="CLAMP_TO_EDGE"' +
  ' magnificationFilter="NEAREST_PIXEL" minificationFilter="NEAREST_PIXEL"></TextureProperties>';
const pixels = Array.from({ length: 8 }, (_, n) => {
  const texel = 4 * (n < 4 ? n + 4 : n - 4); // the lowest row first
  return `0x${Buffer.from(picture.data.subarray(texel, texel + 4)).toString("hex")}`;
});

const colorsOf = (texture: string): string => `<UnlitMaterial>${texture}</UnlitMaterial>`;
const imageColors = (file: keyof typeof files): string =>
  colorsOf(`<ImageTexture url="${file}" containerField="emissiveTexture">${properties}</ImageTexture>`);
const normals = (file: keyof typeof files): string =>
  `<Material><ImageTexture url="${file}" containerField="normalTexture">${properties}</ImageTexture></Material>`;

/** Colours from every file and from numbers in the document, and normals, which are no colours. */
const materials = {
  "rgba.png": imageColors("rgba.png"),
  "gray.png": imageColors("gray.png"),
  "deep.png": imageColors("deep.png"),
  "gamma.png": imageColors("gamma.png"),
  "soft.webp": imageColors("soft.webp"),
  "soft.avif": imageColors("soft.avif"),
  "lossless.webp": imageColors("lossless.webp"),
  numbers: colorsOf(
    `<PixelTexture image="4 2 4 ${pixels.join(" ")}" containerField="emissiveTexture">${properties}</PixelTexture>`,
  ),
  normals: normals("gamma.png"),
  "deep normals": normals("deep-gamma.png"),
};

const perRow = 5;

/** The directory of the page, without some materials. */
export function alphaPage(name: string, without: readonly (keyof typeof materials)[] = []): string {
  const shapes = Object.entries(materials).map(([key, material], n) => {
    if (without.some((other) => other === key)) return "";
    const [x, y] = [1.05 * (n % perRow) - 2.6, n < perRow ? 0.05 : -1.05];
    return `<Transform translation="${x} ${y} 0"><Shape><Appearance alphaMode="OPAQUE">${material}</Appearance>
      <IndexedFaceSet coordIndex="0 1 2 3 -1"><Coordinate point="0 0 0 1 0 0 1 1 0 0 1 0"></Coordinate>
      <TextureCoordinate point="0 0 1 0 1 1 0 1"></TextureCoordinate></IndexedFaceSet></Shape></Transform>`;
  });
  const view = `<Background skyColor="0.2 0.2 0.2"></Background><Viewpoint position="0 0 5"></Viewpoint>`;
  const directory = sceneOf(name, { site: siteOfGenerated("sphere") }, view + shapes.join("\n"));
  for (const [file, bytes] of Object.entries(files)) writeFileSync(join(directory, file), bytes);
  return directory;
}

/** Self-contained: the browser's bitmaps are multiplied by alpha, whatever is asked for, as Safari's. */
export function loseColors(): void {
  const make = createImageBitmap as (...needed: unknown[]) => Promise<ImageBitmap>;
  globalThis.createImageBitmap = (image: unknown, options?: unknown) =>
    make(image, { ...(options as ImageBitmapOptions | undefined), premultiplyAlpha: "premultiply" });
}

/** Self-contained: nothing tells the runtime that the browser keeps colours. */
export function hideDecoder(): void {
  Reflect.deleteProperty(globalThis, "ImageDecoder");
}
