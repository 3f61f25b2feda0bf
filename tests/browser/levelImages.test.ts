// Meshes with levels of detail whose groups have images of their own, in place of the atlas of the whole mesh.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdirSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { assertSamePicture, difference, savePicture } from "./compare.ts";
import { finalPicture, until, withPage, type View } from "./harness.ts";
import { groupFilesOf, magentaInside, onMagenta, seenFrom, statisticsOf } from "./levelPages.ts";
import { converter, outputDirectory } from "./paths.ts";
import { decodePng, encodePng, type Picture } from "./png.ts";
import { siteOf, variantOf } from "./sites.ts";
import { soakTest } from "./soak.ts";

const cells = 160;
const chartCells = 40;
const chartsPerRow = cells / chartCells;
const atlasEdge = 2048;

/** A texture coordinate in a chart, around which a tenth of its cell in the atlas stays empty. */
const inChart = (cell: number, step: number): number => (cell + 0.1 + (0.8 * step) / chartCells) / chartsPerRow;

/** A relief in sixteen charts, each elsewhere in the atlas, in a color of its own with waves. */
function source(): string {
  const folder = join(outputDirectory, "levelImages");
  mkdirSync(folder, { recursive: true });
  const lines = ["mtllib relief.mtl", "usemtl relief"];
  for (let y = 0; y <= cells; ++y)
    for (let x = 0; x <= cells; ++x) {
      const height = 0.05 * Math.sin(0.13 * x) + 0.04 * Math.cos(0.09 * y + 0.02 * x);
      lines.push(`v ${x / cells - 0.5} ${y / cells - 0.5} ${height}`);
    }
  const faces: string[] = [];
  for (let chart = 0, first = 1; chart < chartsPerRow ** 2; ++chart, first += (chartCells + 1) ** 2) {
    const [left, top] = [(chart % chartsPerRow) * chartCells, Math.floor(chart / chartsPerRow) * chartCells];
    const corner = (chart * 7) % chartsPerRow ** 2;
    for (let y = 0; y <= chartCells; ++y)
      for (let x = 0; x <= chartCells; ++x)
        lines.push(`vt ${inChart(corner % chartsPerRow, x)} ${inChart(Math.floor(corner / chartsPerRow), y)}`);
    for (let y = 0; y < chartCells; ++y)
      for (let x = 0; x < chartCells; ++x) {
        const corners = [
          [0, 0],
          [1, 0],
          [1, 1],
          [0, 1],
        ].map(([dx = 0, dy = 0]) => {
          const vertex = 1 + (top + y + dy) * (cells + 1) + left + x + dx;
          return `${vertex}/${first + (y + dy) * (chartCells + 1) + x + dx}`;
        });
        faces.push(`f ${corners.join(" ")}`);
      }
  }
  const data = new Uint8Array(3 * atlasEdge * atlasEdge);
  for (let y = 0; y < atlasEdge; ++y)
    for (let x = 0; x < atlasEdge; ++x) {
      const chart =
        Math.floor((x * chartsPerRow) / atlasEdge) + chartsPerRow * Math.floor((y * chartsPerRow) / atlasEdge);
      const wave = 30 * Math.sin(0.02 * x) * Math.cos(0.015 * y);
      const color = [(chart % 4) * 60 + 30, Math.floor(chart / 4) * 60 + 30, (chart % 3) * 80 + 40];
      data.set(
        color.map((channel) => channel + wave),
        3 * (y * atlasEdge + x),
      );
    }
  writeFileSync(join(folder, "atlas.png"), encodePng({ width: atlasEdge, height: atlasEdge, channels: 3, data }));
  writeFileSync(join(folder, "relief.mtl"), "newmtl relief\nKd 1 1 1\nmap_Kd atlas.png\n");
  writeFileSync(join(folder, "relief.obj"), [...lines, ...faces, ""].join("\n"));
  return join(folder, "relief.obj");
}

let file: string | undefined;
const plainSite = (): string => siteOf((file ??= source()), "--no-pictures", "--up", "y");
const levelsSite = (): string =>
  siteOf((file ??= source()), "--no-pictures", "--up", "y", "--levels", "always", "--group-triangles", "4096");

const pathsOf = ({ requestedPaths }: View, pattern: RegExp): string[] =>
  requestedPaths.filter((path) => pattern.test(path));
const images = /^geometry\/[0-9a-f]{16}\/\d+\/\d+\.webp$/;

for (const [name, position] of [
  ["far", "0 0 6"],
  ["middle", "0 0 1.4"],
  ["near", "0.2 0.1 0.4"],
] as const)
  soakTest(
    `groups with images have the picture of the whole atlas, ${name}, and the atlas is not requested`,
    async () => {
      const seen = (page: string) => seenFrom(page, position, "0 1 0 0");
      const expected = await finalPicture(variantOf(plainSite(), name, seen));
      await withPage(variantOf(levelsSite(), name, seen), {}, async (view) => {
        await view.promise("complete");
        assertSamePicture(`level images ${name}`, await view.picture(), expected, { mean: 2.5, offShare: 0.03 });
        const requested = pathsOf(view, images);
        assert.deepEqual(requested, [...new Set(requested)], "an image was requested twice");
        assert.deepEqual(
          requested.map((path) => path.replace(/webp$/, "png")).sort(),
          groupFilesOf(view).sort(),
          "each group that is requested has its image",
        );
        assert.deepEqual(pathsOf(view, /^textures\//), []);
        const { levels } = await statisticsOf(view);
        assert.ok(levels.bytes > levels.groups * 4 * 10_000, `${levels.bytes} bytes of ${levels.groups} groups`);
      });
    },
  );

test("a group whose image is missing is one error, and its parents stay drawn", async () => {
  const site = variantOf(levelsSite(), "missing", (page) => seenFrom(page, "0 0 1.4", "0 1 0 0"));
  const server = (server: View["server"]): void => {
    server.when((path) => path.endsWith("/0/2.webp"), { status: 404 });
  };
  await withPage(site, { server, expectedErrors: /404|2\.webp/ }, async (view) => {
    await until("an error", async () => (await view.events("error", "x3d")).length > 0);
    await until("all groups", async () => (await statisticsOf(view)).openRequests === 0);
    const errors = await view.events("error", "x3d");
    assert.deepEqual(
      errors.map(({ detail }) => detail.type),
      ["http"],
    );
    const expected = await finalPicture(
      variantOf(plainSite(), "missing", (page) => seenFrom(page, "0 0 1.4", "0 1 0 0")),
    );
    assertSamePicture("level images missing", await view.picture(), expected, { mean: 6, offShare: 0.2 });
  });
});

const fragmentCount = 6 * 41 ** 2;

/** A relief in charts of two triangles each, of which groups have images of new charts. */
function fragments(): string {
  const file = join(outputDirectory, "fragments.ply");
  mkdirSync(outputDirectory, { recursive: true });
  const size = ["--triangles", `${2 * fragmentCount}`, "--charts", `${fragmentCount}`];
  execFileSync(converter, ["sample", "relief", ...size, "-o", file], { stdio: "ignore" });
  return file;
}

/** The same with an atlas that is magenta where no chart touches it. */
function fragmentsOnMagenta(): string {
  const file = join(outputDirectory, "fragmentsOnMagenta.ply");
  const header = readFileSync(fragmentsFile(), "latin1").replace("fragments.png", "fragmentsOnMagenta.png");
  writeFileSync(file, header, "latin1");
  const atlas = decodePng(readFileSync(fragmentsFile().replace(/ply$/, "png")));
  const cell = atlas.width / Math.ceil(Math.sqrt(fragmentCount));
  const margin = cell / 16; // of the sample, on each side of a chart
  const isGutter = (at: number): boolean => (at % cell) + 1 < margin || at % cell > cell - margin;
  let gutters = 0;
  for (let y = 0; y < atlas.height; ++y)
    for (let x = 0; x < atlas.width; ++x)
      if (isGutter(x) || isGutter(y)) {
        atlas.data.set([255, 0, 255], atlas.channels * (y * atlas.width + x));
        ++gutters;
      }
  assert.ok(gutters > 0.1 * atlas.width * atlas.height, `${gutters} texels between charts`);
  writeFileSync(file.replace(/ply$/, "png"), encodePng(atlas));
  return file;
}

let fragmentsPath: string | undefined;
let onMagentaPath: string | undefined;
const fragmentsFile = (): string => (fragmentsPath ??= fragments());
const onMagentaFile = (): string => (onMagentaPath ??= fragmentsOnMagenta());
const inGroups = ["--no-pictures", "--levels", "always", "--group-triangles", "1024"];

/** The largest mean difference of pictures in squares of so many pixels, which one wrong chart raises. */
function largestOfSquares(a: Picture, b: Picture, edge = 40): number {
  const square = ({ width, channels, data }: Picture, left: number, top: number): Picture => {
    const rows = Array.from({ length: edge }, (_, y) => {
      const first = channels * ((top + y) * width + left);
      return data.subarray(first, first + channels * edge);
    });
    return { width: edge, height: edge, channels, data: Buffer.concat(rows) };
  };
  let largest = 0;
  for (let top = 0; top + edge <= a.height; top += edge)
    for (let left = 0; left + edge <= a.width; left += edge)
      largest = Math.max(largest, difference(square(a, left, top), square(b, left, top)).mean);
  return largest;
}

for (const [name, position, squares] of [
  ["far", "0 0 4", 8],
  ["near", "0.2 0.1 1.3", 3],
] as const)
  soakTest(`groups with images of new charts have the picture of the fragmented atlas, ${name}`, async () => {
    const seen = (page: string) => onMagenta(seenFrom(page, position, "0 1 0 0"));
    const plain = siteOf(fragmentsFile(), "--no-pictures", "--levels", "never");
    const expected = await finalPicture(variantOf(plain, name, seen));
    await withPage(variantOf(siteOf(onMagentaFile(), ...inGroups), name, seen), {}, async (view) => {
      await view.promise("complete");
      const actual = await view.picture();
      assertSamePicture(`new charts ${name}`, actual, expected, { mean: 1.6, offShare: 0.025 });
      const found = largestOfSquares(actual, expected);
      if (found > squares) savePicture(`new charts ${name} square`, actual);
      assert.ok(found <= squares, `a square of the picture differs by ${found} in the mean`);
      assert.equal(magentaInside(actual), 0);
      assert.equal(pathsOf(view, images).length, groupFilesOf(view).length);
      assert.ok(pathsOf(view, images).length > 0);
      assert.deepEqual(pathsOf(view, /^textures\//), []);
    });
  });

soakTest("texels between the charts of a fragmented atlas are not in the images of groups", () => {
  const filesOf = (site: string): string[] =>
    readdirSync(join(site, "geometry"), { recursive: true, encoding: "utf8" }).sort();
  const [own, other] = [siteOf(fragmentsFile(), ...inGroups), siteOf(onMagentaFile(), ...inGroups)];
  const files = filesOf(own);
  assert.ok(files.filter((file) => file.endsWith(".webp")).length > 20);
  assert.deepEqual(filesOf(other), files); // folders have the names of their contents
  for (const file of files.filter((file) => file.endsWith(".webp")))
    assert.deepEqual(readFileSync(join(other, "geometry", file)), readFileSync(join(own, "geometry", file)), file);
});
