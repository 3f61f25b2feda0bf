// Draws pages in Firefox and in WebKit, and compares the pictures with Chromium's. All draw by Mesa's software
// renderer, so that most pictures are equal in every bit.

import assert from "node:assert/strict";
import type { TestContext } from "node:test";
import { assertSamePicture, difference } from "../browser/compare.ts";
import { decodePng, type Picture } from "../browser/png.ts";
import { soakTest } from "../browser/soak.ts";
import { stillPicture } from "../browser/stillPicture.ts";
import { chromium } from "./chromium.ts";
import { boundsOf } from "./differences.ts";
import type { Engine, EnginePage } from "./engine.ts";
import { firefox } from "./firefox.ts";
import type { ComparedPage } from "./pages.ts";
import { servePages } from "./pages.ts";
import { webkit } from "./webkit.ts";

const size = { width: 640, height: 480 };

/** The promise of the scene, once the runtime has started. */
const completion = `(async () => {
  const x3d = document.querySelector("x3d");
  while (x3d.complete === undefined) await new Promise((resolve) => setTimeout(resolve, 50));
  await x3d.complete;
})()`;

async function pictureOf(page: EnginePage): Promise<Picture> {
  return decodePng(await stillPicture(() => page.picture()));
}

async function draw(page: EnginePage, origin: string, { path, change }: ComparedPage): Promise<Picture> {
  await page.goTo(origin + path);
  await page.evaluate(completion);
  if (change !== undefined) await page.evaluate(change);
  return pictureOf(page);
}

/** Clicks the middle of a page with one shape, and drags from there. Returns where the click has hit the shape. */
async function clickAndDrag(page: EnginePage): Promise<readonly number[]> {
  const before = await pictureOf(page);
  await page.evaluate(
    `void document.querySelector("shape").addEventListener("click", ({ hitPnt }) => (globalThis.hit = hitPnt))`,
  );
  await page.drag([[350, 200]]);
  const hit = (await page.evaluate("globalThis.hit")) as number[];
  await page.drag([
    [350, 200],
    [400, 220],
    [450, 240],
  ]);
  const after = await pictureOf(page);
  assert.ok(difference(before, after).mean > 1, "a drag turns the model");
  return hit;
}

function pageNamed(name: string, pages: readonly ComparedPage[]): ComparedPage {
  const page = pages.find((each) => each.name === name);
  assert.ok(page);
  return page;
}

const engines: readonly Engine[] = [firefox, webkit];
for (const engine of engines)
  soakTest(`${engine.name} draws what Chromium draws, and follows the pointer`, async (context: TestContext) => {
    const { server, pages } = await servePages();
    const [expected, actual] = await Promise.all([chromium.open(size), engine.open(size)]);
    try {
      for (const page of pages)
        await context.test(page.name, async () => {
          const [expectedPicture, picture] = await Promise.all([
            draw(expected, server.origin, page),
            draw(actual, server.origin, page),
          ]);
          assertSamePicture(`${page.name}-${engine.name}`, picture, expectedPicture, boundsOf(page.name));
        });
      await context.test("a click hits the shape at the same point, and a drag turns it", async () => {
        const { path } = pageNamed("compact", pages);
        const hits: (readonly number[])[] = [];
        for (const opened of [expected, actual]) {
          await opened.goTo(server.origin + path);
          await opened.evaluate(completion);
          hits.push((await clickAndDrag(opened)).map((value) => Number(value.toFixed(3))));
        }
        assert.equal(hits[0]?.length, 3);
        assert.deepEqual(hits[1], hits[0]);
      });
    } finally {
      await Promise.all([expected.close(), actual.close()]);
      await server.close();
    }
  });
