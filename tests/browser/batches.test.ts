// Thousands of shapes are few draws, and each of them is still an element: it is
// picked, hidden, moved, coloured and removed like any other, and looks as if it
// were drawn alone.

import assert from "node:assert/strict";
import { cpSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { Matrix4, Quaternion, Vector3 } from "three";
import type { ViewElement } from "../../web/src/dom/imgeoView.ts";
import { assertSamePicture, boundsOfQuantised, difference, isWithin } from "./compare.ts";
import { decodeCompactSite } from "./compactDecoder.ts";
import { pictureSize, settle, until, withPage, type View } from "./harness.ts";
import { placed } from "./placed.ts";
import { referencePicture } from "./reference.ts";
import { decodeSite, type PlainPatch } from "./siteDecoder.ts";
import { pageOf, shapeIn, siteOfGenerated, variantOf, withShapes } from "./sites.ts";

const side = 50;
const distance = 62;
const viewpoint = `<Viewpoint position="0 0 ${distance}" fieldOfView="0.8"></Viewpoint>`;
const pixelsPerUnit = pictureSize.height / 2 / Math.tan(0.4) / distance;

type Point = readonly [x: number, y: number];

function placeOf(n: number): Point {
  return [(n % side) - side / 2 + 0.5, Math.floor(n / side) - side / 2 + 0.5];
}

/** The pixel that shows a point of the plane in which all shapes stand. */
function pixelOf([x, y]: Point): Point {
  return [pictureSize.width / 2 + x * pixelsPerUnit, pictureSize.height / 2 - y * pixelsPerUnit];
}

/** Shapes of one ball, each in a colour of its own, and a box of its own size for every hundredth. */
function crowd(ball: string): string {
  const geometry = /<ImageGeometry[\s\S]*<\/ImageGeometry>/i.exec(ball)?.[0].replace("<ImageGeometry", '<ImageGeometry DEF="ball"') ?? "";
  const shapes = Array.from({ length: side * side }, (_, n) => {
    const [x, y] = placeOf(n);
    const own = n === 0 ? geometry : n % 100 === 1 ? `<Box size="0.8 0.7 ${0.5 + n / 5000}"></Box>` : '<ImageGeometry USE="ball"></ImageGeometry>';
    const color = n % 3 === 0 ? "1 0 0" : `0 ${1 - (n % 7) / 20} 0`;
    return `<Transform translation="${x} ${y} 0" scale="0.45 0.45 0.45"><Shape id="s${n}"><Appearance><Material diffuseColor="${color}"></Material></Appearance>${own}</Shape></Transform>`;
  });
  return shapes.join("\n");
}

/** Draw calls and clears of a frame, counted outside of the runtime. */
async function drawsOfFrame({ page }: View): Promise<number> {
  return page.evaluate(async () => {
    const before = window.observed.draws;
    await document.querySelector<ViewElement>("x3d")!.toBlob();
    return window.observed.draws - before;
  });
}

/** The ids of the shapes at pixels. */
async function shapesAt({ page }: View, points: readonly Point[]): Promise<(string | undefined)[]> {
  await settle(page);
  return page.evaluate((pixels) => pixels.map(([x, y]) =>
    document.querySelector<ViewElement>("x3d")!.positionAndNormalFromPoint(x, y)?.shape.id), points.map(pixelOf));
}

test("2,500 shapes are a few draws, and each follows its element", async () => {
  const site = variantOf(siteOfGenerated("sphere-small", "--profile", "compact"), "crowd", (page) =>
    withShapes(page.replaceAll(/<Viewpoint[^>]*>/gi, viewpoint.replace("</Viewpoint>", "")), crowd));
  await withPage(site, {}, async (view) => {
    await view.promise("complete");
    assert.ok(await drawsOfFrame(view) <= 20, `${await drawsOfFrame(view)} draws`);
    const numbers = [0, 1201, 1250, 1301, 2499];
    assert.deepEqual(await shapesAt(view, numbers.map(placeOf)), numbers.map((n) => `s${n}`));
    await view.page.evaluate(() => {
      document.querySelector("#s1250")!.setAttribute("visible", "false");
      document.querySelector("#s1301")!.closest("transform")!.setAttribute("translation", "30 0 0");
      document.querySelector("#s1201 material")!.setAttribute("diffuseColor", "0 0 1");
      document.querySelector("#s2499")!.remove();
    });
    assert.deepEqual(await shapesAt(view, [...numbers.map(placeOf), [30, 0]]), ["s0", "s1201", undefined, undefined, undefined, "s1301"]);
    const { data, width, channels } = await view.picture();
    const colorAt = (point: Point) => {
      const [x, y] = pixelOf(point);
      const first = (Math.floor(y) * width + Math.floor(x)) * channels;
      return Array.from(data.subarray(first, first + 3));
    };
    const sky = colorAt([0, 25.8]);
    const strongest = (color: number[]) => color.indexOf(Math.max(...color));
    assert.deepEqual([1250, 1301, 2499].map((n) => colorAt(placeOf(n))), [sky, sky, sky]);
    assert.deepEqual([0, 1201, 1251, 1252].map((n) => strongest(colorAt(placeOf(n)))), [0, 2, 0, 1]);
    assert.ok(await drawsOfFrame(view) <= 20);
  });
});

/** In the page. The context may be asked for again when all have heard that it is lost. */
async function loseContextForAMoment(): Promise<void> {
  const canvas = document.querySelector("imgeo-view")!.shadowRoot!.querySelector("canvas")!;
  const loser = canvas.getContext("webgl2")!.getExtension("WEBGL_lose_context")!;
  const heard = (name: string) => new Promise((resolve) => { canvas.addEventListener(name, () => setTimeout(resolve), { once: true }); });
  const lost = heard("webglcontextlost");
  loser.loseContext();
  await lost;
  const restored = heard("webglcontextrestored");
  loser.restoreContext();
  await restored;
}

const copies = 12;

/** Turned, stretched, and every third one mirrored. */
function matrixOfCopy(n: number, x: number): { markup: string; matrix: Matrix4 } {
  const scale = new Vector3(n % 3 === 0 ? -0.2 : 0.2, 0.15 + n / 80, 0.25);
  const position = new Vector3(x, (n - (copies - 1) / 2) / 3, (n % 2) / 4);
  const axis = new Vector3(1, n, 2).normalize();
  const matrix = new Matrix4().compose(position, new Quaternion().setFromAxisAngle(axis, n), scale);
  const text = (vector: Vector3) => vector.toArray().join(" ");
  return { matrix, markup: `<Transform translation="${text(position)}" rotation="${text(axis)} ${n}" scale="${text(scale)}">` };
}

test("what is drawn together looks as if drawn alone: instances of images, and merged buffers", async () => {
  const images = siteOfGenerated("trefoil", "--profile", "classic", "--position-bits", "8"); // small on the screen, more bits would wait
  const buffers = siteOfGenerated("sphere-small", "--profile", "compact");
  const inOther = shapeIn(pageOf(buffers)).replaceAll("geometry/", "other/geometry/");
  const look = /<Appearance[\s\S]*<\/Appearance>/i.exec(shapeIn(pageOf(images)))?.[0] ?? "";
  const ball = inOther.replace(/<Appearance[\s\S]*<\/Appearance>/i, () => look);
  const expected: PlainPatch[] = [];
  const scene = (knot: string): string => Array.from({ length: copies }, (_, n) => {
    const [left, right] = [matrixOfCopy(n, -1.2), matrixOfCopy(n, 1.2)];
    const geometry = n === 0 ? knot.replace("<ImageGeometry", '<ImageGeometry DEF="knot"')
      : knot.replace(/<ImageGeometry[\s\S]*<\/ImageGeometry>/i, '<ImageGeometry USE="knot"></ImageGeometry>');
    expected.push(...placed(decodeSite(images), left.matrix), ...placed(decodeCompactSite(buffers), right.matrix));
    return `${left.markup}${geometry}</Transform>${right.markup}${ball}</Transform>`;
  }).join("\n");
  const page = withShapes(pageOf(images), scene);
  const site = variantOf(images, "together", () => page);
  cpSync(buffers, join(site, "other"), { recursive: true });
  await withPage(site, {}, async (view) => {
    await view.promise("complete");
    const reference = await referencePicture(page, expected);
    assertSamePicture("together", await view.picture(), reference, boundsOfQuantised);
    assert.ok(await drawsOfFrame(view) <= 6, `${await drawsOfFrame(view)} draws`);
    await view.page.evaluate(loseContextForAMoment);
    await until("all is back after its context was lost", async () => isWithin(difference(await view.picture(), reference), boundsOfQuantised));
    assert.ok(await drawsOfFrame(view) <= 6);
  });
});
