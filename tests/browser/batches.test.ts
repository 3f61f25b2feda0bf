// Tests that thousands of shapes take few draw calls, that each of them follows its element (picking, visibility,
// transform, colour, removal), and that the picture is the same as if each were drawn alone.

import assert from "node:assert/strict";
import { cpSync, mkdirSync, readdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { Matrix4, Quaternion, Vector3 } from "three";
import type { ViewElement } from "../../web/src/dom/imgeoView.ts";
import { assertSamePicture, boundsOfQuantised, difference, isWithin, savePicture } from "./compare.ts";
import { decodeCompactSite } from "./compactDecoder.ts";
import { drawsOfFrame, pictureSize, settle, until, withPage, type View } from "./harness.ts";
import { soakTest } from "./soak.ts";
import { transformedPatches } from "./transformedPatches.ts";
import { referencePicture } from "./reference.ts";
import { decodeSite, type PlainPatch } from "./siteDecoder.ts";
import { writePly } from "./meshes.ts";
import { outputDirectory } from "./paths.ts";
import { pageOf, shapeIn, siteOf, siteOfGenerated, variantOf, withShapes } from "./sites.ts";

const side = 50;
const distance = 62;
const viewpoint = `<Viewpoint position="0 0 ${distance}" fieldOfView="0.8"></Viewpoint>`;
const pixelsPerUnit = pictureSize.height / 2 / Math.tan(0.4) / distance;

type Point = readonly [x: number, y: number];

function positionOf(n: number): Point {
  return [(n % side) - side / 2 + 0.5, Math.floor(n / side) - side / 2 + 0.5];
}

/** The pixel at a point of the plane z = 0. */
function pixelOf([x, y]: Point): Point {
  return [pictureSize.width / 2 + x * pixelsPerUnit, pictureSize.height / 2 - y * pixelsPerUnit];
}

/** Instances of one ball in several colours; every hundredth shape is a box of a different size. */
function crowd(ball: string): string {
  const geometry =
    /<ImageGeometry[\s\S]*<\/ImageGeometry>/i.exec(ball)?.[0].replace("<ImageGeometry", '<ImageGeometry DEF="ball"') ??
    "";
  const shapes = Array.from({ length: side * side }, (_, n) => {
    const [x, y] = positionOf(n);
    const own =
      n === 0
        ? geometry
        : n % 100 === 1
          ? `<Box size="0.8 0.7 ${0.5 + n / 5000}"></Box>`
          : '<ImageGeometry USE="ball"></ImageGeometry>';
    const color = n % 3 === 0 ? "1 0 0" : `0 ${1 - (n % 7) / 20} 0`;
    return `<Transform translation="${x} ${y} 0" scale="0.45 0.45 0.45"><Shape id="s${n}"><Appearance><Material diffuseColor="${color}"></Material></Appearance>${own}</Shape></Transform>`;
  });
  return shapes.join("\n");
}

/** The ids of the shapes at pixels. */
async function shapesAt({ page }: View, points: readonly Point[]): Promise<(string | undefined)[]> {
  await settle(page);
  return page.evaluate(
    (pixels) =>
      pixels.map(([x, y]) => document.querySelector<ViewElement>("x3d")!.positionAndNormalFromPoint(x, y)?.shape.id),
    points.map(pixelOf),
  );
}

/**
 * Asserts that shapes s0 to s2499 at positionOf() take few draw calls, and are picked, hidden, moved, removed and
 * coloured one by one. `colorAfter`: the strongest channel of some shapes after that, where s1201 is blue.
 */
async function assertShapesFollowTheirElements(view: View, colorAfter: readonly [n: number, channel: number][]) {
  await view.promise("complete");
  assert.ok((await drawsOfFrame(view)) <= 20, `${await drawsOfFrame(view)} draws`);
  const numbers = [0, 1201, 1250, 1301, 2499];
  assert.deepEqual(
    await shapesAt(view, numbers.map(positionOf)),
    numbers.map((n) => `s${n}`),
  );
  await view.page.evaluate(() => {
    document.querySelector("#s1250")!.setAttribute("visible", "false");
    document.querySelector("#s1301")!.closest("transform")!.setAttribute("translation", "30 0 0");
    document.querySelector("#s1201 appearance")!.outerHTML =
      '<appearance><material diffuseColor="0 0 1"></material></appearance>';
    document.querySelector("#s2499")!.remove();
  });
  assert.deepEqual(await shapesAt(view, [...numbers.map(positionOf), [30, 0]]), [
    "s0",
    "s1201",
    undefined,
    undefined,
    undefined,
    "s1301",
  ]);
  const { data, width, channels } = await view.picture();
  const colorAt = (point: Point) => {
    const [x, y] = pixelOf(point);
    const first = (Math.floor(y) * width + Math.floor(x)) * channels;
    return Array.from(data.subarray(first, first + 3));
  };
  const sky = colorAt([0, 25.8]);
  const strongest = (color: number[]) => color.indexOf(Math.max(...color));
  assert.deepEqual(
    [1250, 1301, 2499].map((n) => colorAt(positionOf(n))),
    [sky, sky, sky],
  );
  assert.deepEqual(
    colorAfter.map(([n]) => strongest(colorAt(positionOf(n)))),
    colorAfter.map(([, channel]) => channel),
  );
  assert.ok((await drawsOfFrame(view)) <= 20);
}

soakTest("2,500 shapes take few draw calls, and each follows its element", async () => {
  const site = variantOf(siteOfGenerated("sphere-small", "--profile", "compact"), "crowd", (page) =>
    withShapes(page.replaceAll(/<Viewpoint[^>]*>/gi, viewpoint.replace("</Viewpoint>", "")), crowd),
  );
  await withPage(site, {}, (view) =>
    assertShapesFollowTheirElements(view, [
      [0, 0],
      [1201, 2],
      [1251, 0],
      [1252, 1],
    ]),
  );
});

/** An X3D file of 2,500 flat polygons of 16 corners, no two alike, in red and green: too much text for a page. */
function tinyShapesFile(): string {
  const corners = 16;
  const shapes = Array.from({ length: side * side }, (_, n) => {
    const [x, y] = positionOf(n);
    const [radius, tilt] = [0.35 + (n % 97) / 1000, (n % 89) / 1000];
    const points = Array.from({ length: corners }, (__, corner) => {
      const angle = (2 * Math.PI * corner) / corners;
      const [px, py] = [radius * Math.cos(angle), radius * Math.sin(angle)];
      return `${px.toFixed(5)} ${py.toFixed(5)} ${(tilt * px).toFixed(5)}`;
    });
    const index = Array.from({ length: corners }, (__, corner) => corner).join(" ");
    return `<Transform translation="${x} ${y} 0"><Shape DEF="s${n}"><Appearance USE="${n % 2 === 0 ? "red" : "green"}"/>
      <IndexedFaceSet solid="false" coordIndex="${index} -1"><Coordinate point="${points.join(" ")}"/></IndexedFaceSet></Shape></Transform>`;
  });
  const colored = (name: string, color: string): string =>
    `<Shape><Appearance DEF="${name}"><Material diffuseColor="${color}"/></Appearance></Shape>`;
  mkdirSync(outputDirectory, { recursive: true });
  const file = join(outputDirectory, "tiny-shapes.x3d");
  writeFileSync(
    file,
    `<X3D version="4.0" profile="Interchange"><Scene>${viewpoint}${colored("red", "1 0 0")}${colored("green", "0 1 0")}
      ${shapes.join("\n")}</Scene></X3D>`,
  );
  return file;
}

soakTest("2,500 shapes that share a file take few draw calls, and each follows its element", async () => {
  const shared = siteOf(tinyShapesFile());
  const site = variantOf(shared, "named", (page) => page.replaceAll(/<Shape DEF="(s\d+)"/g, '<Shape id="$1" DEF="$1"'));
  assert.ok(/<Shape id="s1250"[^>]* patch="[^"]+#\d+"/.test(pageOf(site)), "the shapes have files of their own");
  assert.ok(readdirSync(join(site, "geometry")).length <= 3);
  await withPage(site, {}, (view) =>
    assertShapesFollowTheirElements(view, [
      [0, 0],
      [1201, 2],
      [1251, 1],
      [1252, 0],
    ]),
  );
});

/** Runs in the page. The context may be restored only after all listeners have handled its loss. */
async function loseContextForAMoment(): Promise<void> {
  const canvas = document.querySelector("imgeo-view")!.shadowRoot!.querySelector("canvas")!;
  const loser = canvas.getContext("webgl2")!.getExtension("WEBGL_lose_context")!;
  const eventOf = (name: string) =>
    new Promise((resolve) => {
      canvas.addEventListener(name, () => setTimeout(resolve), { once: true });
    });
  const lost = eventOf("webglcontextlost");
  loser.loseContext();
  await lost;
  const restored = eventOf("webglcontextrestored");
  loser.restoreContext();
  await restored;
}

const copyCount = 12;

/** A rotated and scaled copy; every third one is mirrored. */
function matrixOfCopy(n: number, x: number): { markup: string; matrix: Matrix4 } {
  const scale = new Vector3(n % 3 === 0 ? -0.2 : 0.2, 0.15 + n / 80, 0.25);
  const position = new Vector3(x, (n - (copyCount - 1) / 2) / 3, (n % 2) / 4);
  const axis = new Vector3(1, n, 2).normalize();
  const matrix = new Matrix4().compose(position, new Quaternion().setFromAxisAngle(axis, n), scale);
  const text = (vector: Vector3) => vector.toArray().join(" ");
  return {
    matrix,
    markup: `<Transform translation="${text(position)}" rotation="${text(axis)} ${n}" scale="${text(scale)}">`,
  };
}

test("batches of instances of images and of merged buffers have the same picture as shapes drawn alone", async () => {
  // 8 bits: a second byte would not be requested for knots as small as these.
  const images = siteOfGenerated("trefoil", "--profile", "classic", "--position-bits", "8");
  const buffers = siteOfGenerated("sphere-small", "--profile", "compact");
  const inOther = shapeIn(pageOf(buffers)).replaceAll("geometry/", "other/geometry/");
  const appearance = /<Appearance[\s\S]*<\/Appearance>/i.exec(shapeIn(pageOf(images)))?.[0] ?? "";
  const ball = inOther.replace(/<Appearance[\s\S]*<\/Appearance>/i, () => appearance);
  const expected: PlainPatch[] = [];
  const scene = (knot: string): string =>
    Array.from({ length: copyCount }, (_, n) => {
      const [left, right] = [matrixOfCopy(n, -1.2), matrixOfCopy(n, 1.2)];
      const geometry =
        n === 0
          ? knot.replace("<ImageGeometry", '<ImageGeometry DEF="knot"')
          : knot.replace(/<ImageGeometry[\s\S]*<\/ImageGeometry>/i, '<ImageGeometry USE="knot"></ImageGeometry>');
      expected.push(
        ...transformedPatches(decodeSite(images), left.matrix),
        ...transformedPatches(decodeCompactSite(buffers), right.matrix),
      );
      return `${left.markup}${geometry}</Transform>${right.markup}${ball}</Transform>`;
    }).join("\n");
  const page = withShapes(pageOf(images), scene);
  const site = variantOf(images, "together", () => page);
  cpSync(buffers, join(site, "other"), { recursive: true });
  await withPage(site, {}, async (view) => {
    await view.promise("complete");
    const reference = await referencePicture(page, expected);
    assertSamePicture("together", await view.picture(), reference, boundsOfQuantised);
    assert.ok((await drawsOfFrame(view)) <= 6, `${await drawsOfFrame(view)} draws`);
    await view.page.evaluate(loseContextForAMoment);
    await until("the picture is back after the context was lost", async () =>
      isWithin(difference(await view.picture(), reference), boundsOfQuantised),
    );
    assert.ok((await drawsOfFrame(view)) <= 6);
  });
});

/** Positions, colours and transparencies of the panes. */
const panes = Array.from({ length: 24 }, (_, n) => ({
  // Three stacks of eight panes that partly cover each other; all different and unsorted.
  z: ((n * 7) % 24) / 8,
  x: (n % 3) * 1.6 - 1.6 + (n % 5) / 20,
  y: (n % 4) / 10,
  color: [(n % 2) * 0.9 + 0.05, ((n * 5) % 7) / 7, ((n * 3) % 5) / 5],
  transparency: 0.3 + (n % 4) / 8,
}));

/** Flat transparent squares; every third is read from images. */
function panesMarkup(image: string): string {
  return panes
    .map(({ x, y, z, color, transparency }, n) => {
      const appearance = `<Appearance><UnlitMaterial emissiveColor="${color.join(" ")}" transparency="${transparency}"></UnlitMaterial></Appearance>`;
      const square =
        n % 3 === 2
          ? n === 2
            ? image.replace("<ImageGeometry", '<ImageGeometry DEF="pane"')
            : '<ImageGeometry USE="pane"></ImageGeometry>'
          : `<IndexedFaceSet solid="false" coordIndex="0 1 2 3 -1"><Coordinate point="-1 -1 0 1 -1 0 1 1 0 -1 1 0"></Coordinate></IndexedFaceSet>`;
      return `<Transform translation="${x} ${y} ${z}"><Shape id="p${n}">${appearance}${square}</Shape></Transform>`;
    })
    .join("");
}

soakTest("transparent panes take few draw calls, and are blended from back to front seen from both sides", async () => {
  const away = 12;
  const images = siteOf(squareFile(), "--profile", "classic");
  const image =
    /<ImageGeometry[\s\S]*<\/ImageGeometry>/i
      .exec(shapeIn(pageOf(images)))?.[0]
      .replace("<ImageGeometry", '<ImageGeometry solid="false"') ?? "";
  const views = [
    `<Viewpoint id="front" position="0 0 ${away}" fieldOfView="0.8"></Viewpoint>`,
    `<Viewpoint id="behind" position="0 0 ${-away}" orientation="0 1 0 ${Math.PI}" fieldOfView="0.8"></Viewpoint>`,
  ];
  const site = variantOf(images, "panes", (page) =>
    withShapes(page, () => panesMarkup(image))
      .replaceAll(/<Background[^>]*><\/Background>/gi, "")
      .replaceAll(
        /<Viewpoint[^>]*><\/Viewpoint>/gi,
        () => `<Background skyColor="0 0 0"></Background>${views.splice(0).join("")}`,
      ),
  );
  const isImage = (pane: (typeof panes)[number]) => panes.indexOf(pane) % 3 === 2;
  const alternations = panes
    .toSorted((a, b) => a.z - b.z)
    .filter((pane, n, all) => n === 0 || isImage(pane) !== isImage(all[n - 1]!)).length;
  await withPage(site, {}, async (view) => {
    await view.promise("complete");
    for (const side of [1, -1]) {
      if (side < 0)
        await view.page.evaluate(() => {
          document.querySelector("#behind")!.setAttribute("set_bind", "true");
        });
      const picture = await view.picture();
      savePicture(`panes${side}`, picture);
      assert.ok((await drawsOfFrame(view)) <= alternations + 2, `${await drawsOfFrame(view)} draws`);
      let compared = 0;
      for (let n = 0; n < 400; ++n) {
        const at: Point = [(n % 20) / 4 - 2.4, Math.floor(n / 20) / 10 - 0.87];
        const expectedColor = blendedAt(at, side * away);
        if (expectedColor === undefined) continue;
        compared += 1;
        const scale = pictureSize.height / 2 / Math.tan(0.4) / away;
        const [x, y] = [
          Math.floor(pictureSize.width / 2 + side * at[0] * scale),
          Math.floor(pictureSize.height / 2 - at[1] * scale),
        ];
        const found = Array.from(
          picture.data.subarray(
            (y * picture.width + x) * picture.channels,
            (y * picture.width + x) * picture.channels + 3,
          ),
        );
        assert.ok(
          expectedColor.every((channel, i) => Math.abs(channel - found[i]!) <= 3),
          `side ${side}, at ${at.join()}: ${found.join()} instead of ${expectedColor.join()}`,
        );
      }
      assert.ok(compared > 100, `${compared} points`);
    }
  });
});

/**
 * The blended colour, 0 … 255, on the ray from the eye to a point of the plane z = 0; undefined near borders of panes.
 */
function blendedAt([x, y]: Point, eye: number): number[] | undefined {
  const farFirst = panes.toSorted((a, b) => (a.z - b.z) * Math.sign(eye));
  let color = [0, 0, 0];
  for (const pane of farFirst) {
    const share = (eye - pane.z) / eye;
    const off = [Math.abs(x * share - pane.x), Math.abs(y * share - pane.y)];
    if (off.some((distance) => Math.abs(distance - 1) < 0.04)) return undefined;
    if (off.some((distance) => distance > 1)) continue;
    color = color.map((channel, i) => pane.transparency * channel + (1 - pane.transparency) * 255 * pane.color[i]!);
  }
  return color;
}

function squareFile(): string {
  const path = join(outputDirectory, "pane.ply");
  mkdirSync(outputDirectory, { recursive: true });
  writeFileSync(
    path,
    writePly({
      positions: Float32Array.from([-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0]),
      triangles: Uint32Array.from([0, 1, 2, 0, 2, 3]),
    }),
  );
  return path;
}
