// Tests a scene of several documents as `imgeo convert` writes it: Inlines, LODs, and changes of both in the page.

import assert from "node:assert/strict";
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import type { Loadable, ViewElement } from "../../web/src/dom/index.ts";
import { settle, until, withPage, type View } from "./harness.ts";
import { outputDirectory } from "./paths.ts";
import type { Picture } from "./png.ts";
import { siteOf } from "./sites.ts";

/**
 * A wall, 2 wide and 2 high, with so many vertices that convert writes files for it. Another number of columns gives
 * other files.
 */
function wall(columns: number): { points: string; faces: string } {
  const points: string[] = [],
    faces: string[] = [];
  for (let y = 0; y <= columns; ++y)
    for (let x = 0; x <= columns; ++x) points.push(`${(2 * x) / columns - 1} ${(2 * y) / columns - 1} 0`);
  for (let y = 0; y < columns; ++y) {
    for (let x = 0; x < columns; ++x) {
      const at = y * (columns + 1) + x;
      faces.push(`${at} ${at + 1} ${at + columns + 2} ${at + columns + 1} -1`);
    }
  }
  return { points: points.join(", "), faces: faces.join(" ") };
}

const plain = (color: string) => `<Appearance><UnlitMaterial emissiveColor="${color}"/></Appearance>`;

/** On the left a red wall in a VRML file; on the right a LOD of a green box (near) and a blue wall in files (far). */
function convertedWorld(): string {
  const folder = join(outputDirectory, "worlds");
  const [red, blue] = [wall(24), wall(30)];
  mkdirSync(join(folder, "parts"), { recursive: true });
  writeFileSync(
    join(folder, "parts/wall.wrl"),
    `#VRML V2.0 utf8
    PROTO Panel [ field SFColor paint 1 1 1 ] {
      Shape { appearance Appearance { material Material { diffuseColor 0 0 0 emissiveColor IS paint } }
      geometry IndexedFaceSet { coordIndex [ ${red.faces} ] coord Coordinate { point [ ${red.points} ] } } } }
    DEF Wall Transform { translation -2 0 0 children Panel { paint 1 0 0 } }`,
  );
  writeFileSync(
    join(folder, "world.x3d"),
    `<X3D version="3.3"><Scene><Viewpoint DEF="V" position="0 0 10"/><NavigationInfo headlight="false"/>
    <Background skyColor="1 1 1"/><Group id="left"><Inline id="part" url='"parts/wall.wrl"'/></Group>
    <Transform translation="2 0 0"><LOD range="15"><Shape id="near">${plain("0 1 0")}<Box/></Shape>
    <Shape id="far">${plain("0 0 1")}<IndexedFaceSet coordIndex="${blue.faces}"><Coordinate point="${blue.points}"/></IndexedFaceSet></Shape></LOD></Transform></Scene></X3D>`,
  );
  return siteOf(join(folder, "world.x3d"), "--profile", "classic");
}

/** Numbers of red, green and blue pixels. */
function colorsOf({ data, channels }: Picture): { red: number; green: number; blue: number } {
  const seen = { red: 0, green: 0, blue: 0 };
  for (let i = 0; i < data.length; i += channels) {
    const [r = 0, g = 0, b = 0] = data.subarray(i, i + 3);
    if (r > 200 && g < 50 && b < 50) ++seen.red;
    if (g > 200 && r < 50 && b < 50) ++seen.green;
    if (b > 200 && r < 50 && g < 50) ++seen.blue;
  }
  return seen;
}

const geometryRequests = ({ server }: View) => server.requestsOf(/^\/geometry\//).length;

test("inlined documents and levels of detail are fetched, displayed, picked and freed as the page specifies", async () => {
  const site = convertedWorld();
  const server = (test: View["server"]): void => {
    test.put("/held.x3d", "<X3D/>");
    test.when(/held/, { hold: new Promise(() => undefined) });
    test.put(
      "/circle.x3d",
      `<X3D><Scene><Inline url='"circle.x3d"'/><Transform translation="0 2 0"><Shape>${plain("0 1 0")}<Box/></Shape></Transform></Scene></X3D>`,
    );
    test.put("/bomb.x3d", "<!DOCTYPE X3D [<!ENTITY a 'aaaa'>]><X3D/>");
  };
  await withPage(site, { server, expectedErrors: /404|lost|bomb/ }, async (view) => {
    const { page } = view;
    await view.promise("complete");
    const near = colorsOf(await view.picture());
    assert.ok(near.red > 5000 && near.green > 5000 && near.blue === 0, JSON.stringify(near));
    const requestCount = geometryRequests(view);
    assert.ok(
      requestCount > 0 && requestCount <= 4,
      `${requestCount} requests: only files of the red wall are expected`,
    );
    assert.equal(
      await page.evaluate(() => document.querySelectorAll("x3d shape").length),
      2,
      "the page holds no element of the other document",
    );

    // Picking returns the Inline instead of the shapes in its document.
    const hit = await page.evaluate(() => {
      const x3d = document.querySelector<ViewElement>("x3d")!;
      return x3d.positionAndNormalFromPoint(innerWidth / 2 - innerHeight * 0.24, innerHeight / 2)?.shape.id;
    });
    assert.equal(hit, "part");

    // At a larger distance the other level is requested and displayed.
    await page.evaluate(() => {
      document.querySelector("viewpoint")?.setAttribute("position", "0 0 20");
    });
    await until("the other level is requested", () => geometryRequests(view) > requestCount);
    await view.promise("complete");
    const far = colorsOf(await view.picture());
    assert.ok(far.red > 1000 && far.green === 0 && far.blue > 1000, JSON.stringify(far));

    // A removed Inline does not delay loading; its content is removed.
    await page.evaluate(() => {
      document.querySelector("#left")?.insertAdjacentHTML("beforeend", `<inline id="held" url='"held.x3d"'></inline>`);
    });
    await until("the Inline is requested", () => view.server.requestsOf(/held/).length === 1);
    await page.evaluate(() => {
      document.querySelector("#left")?.replaceChildren();
    });
    await until("its request is aborted", () => view.server.requestsOf(/held/)[0]?.state === "aborted");
    await settle(page);
    assert.equal(colorsOf(await view.picture()).red, 0);

    // The first URL that leads to a document is used; an Inline without one has an error.
    await page.evaluate(() => {
      document
        .querySelector("#left")
        ?.insertAdjacentHTML(
          "beforeend",
          `<inline id="circle" url='"lost.x3d" "circle.x3d"'></inline><inline id="bomb" url='"bomb.x3d"'></inline>`,
        );
    });
    await view.promise("complete", "#circle");
    const errors = await page.evaluate(async () => {
      const bomb = document.querySelector<Element & Loadable>("#bomb")!;
      await bomb.complete.catch(() => undefined);
      return bomb.errors.map(({ type, message }) => `${type}: ${message}`);
    });
    assert.equal(errors.length, 1);
    assert.match(errors[0] ?? "", /^unsupported: .*bomb.x3d: its document type defines entities/);
    await settle(page);
    assert.ok(colorsOf(await view.picture()).green > 500);
  });
});
