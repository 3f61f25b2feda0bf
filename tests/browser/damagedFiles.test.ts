// Tests missing, truncated and malformed files: the page keeps working, reports the error, and displays everything
// else.

import assert from "node:assert/strict";
import { cpSync } from "node:fs";
import { join } from "node:path";
import { describe, test } from "node:test";
import { assertSamePicture, difference } from "./compare.ts";
import { pictureOfSite, until, withPage, type View } from "./harness.ts";
import { outputDirectory } from "./paths.ts";
import { encodePng } from "./png.ts";
import type { Behaviour } from "./server.ts";
import { ranksOfFiles } from "./siteDecoder.ts";
import { pageOf, siteOfGenerated } from "./sites.ts";
import { soakTest } from "./soak.ts";
import type { ResourceEntry } from "../../web/src/dom/loadingEvents.ts";

/** A site of two shapes, #good and #bad; the files of #bad are in bad/. */
function twoShapeSite(): string {
  const directory = join(outputDirectory, "sites", "faults");
  cpSync(siteOfGenerated("trefoil", "--profile", "classic"), directory, { recursive: true });
  cpSync(siteOfGenerated("sphere", "--profile", "classic"), join(directory, "bad"), { recursive: true });
  return directory;
}

function shapeOf(html: string, id: string, prefix: string): string {
  const shape = /<Shape[\s\S]*<\/Shape>/i.exec(html)?.[0].replace(/<Shape/i, `<Shape id="${id}"`);
  assert.ok(shape);
  return [...ranksOfFiles(html).keys()].reduce((text, url) => text.replaceAll(url, prefix + url), shape);
}

function twoShapes(html: Buffer): string {
  const good = shapeOf(html.toString(), "good", "");
  const bad = shapeOf(pageOf(siteOfGenerated("sphere", "--profile", "classic")), "bad", "bad/");
  // Large enough that its second byte is visible and therefore requested.
  return html
    .toString()
    .replace(/<Shape[\s\S]*<\/Shape>/i, () => `<Transform scale="2 2 2">${bad}</Transform>\n${good}`);
}

function badFile(rank: number): string {
  const [url] =
    [...ranksOfFiles(pageOf(siteOfGenerated("sphere", "--profile", "classic")))].find(([, other]) => other === rank) ??
    [];
  assert.ok(url);
  return `/bad/${url}`;
}

async function withFault(
  rank: number,
  behaviour: Behaviour,
  use: (view: View, url: string) => Promise<void>,
): Promise<void> {
  const path = badFile(rank);
  const options = {
    server: (server: View["server"]): void => {
      server.when(/^\/$/, { replace: twoShapes });
      server.when((requestedPath) => requestedPath === path, behaviour);
    },
    expectedErrors: /Failed to load resource|imgeo/,
  };
  await withPage(twoShapeSite(), options, async (view) => {
    await view.promise("complete", "#good");
    await until("an error is reported", async () => (await view.events("error", "x3d")).length > 0);
    await use(view, view.server.origin + path.slice(1));
  });
}

async function assertReported(view: View, url: string): Promise<void> {
  const errors = await view.events("error");
  const own = view.errors.filter((line) => line.startsWith("imgeo:"));
  assert.equal(own.length, 1, own.join("; "));
  const listed = await view.page.evaluate(() =>
    ["x3d", "#bad", "#good"].map((selector) => {
      const { errors } = document.querySelector(selector) as unknown as { errors: { url: string; message: string }[] };
      return errors.map(({ url, message }) => ({ url, message }));
    }),
  );
  const [inScene, ofBad, ofGood] = listed;
  assert.deepEqual([inScene, ofGood], [ofBad, []]);
  assert.equal(ofBad?.length, 1);
  assert.equal(own[0], `imgeo: ${ofBad[0]!.message}`);
  assert.deepEqual(errors.map(({ target }) => target).sort(), ["shape#bad", "x3d"]);
  for (const { detail } of errors) {
    assert.equal(typeof detail.type, "string");
    assert.ok(url.endsWith(String(detail.url).replace(/^\.?\//, "")), `${String(detail.url)} is not ${url}`);
    assert.equal(detail.element, "shape");
  }
  const resourcesOfBad = () =>
    view.page.evaluate(() => (document.querySelector("#bad") as unknown as { resources: ResourceEntry[] }).resources);
  // The error may come before the other files.
  await until("the other files are loaded", async () =>
    (await resourcesOfBad()).every(({ state }) => state === "ready" || state === "failed"),
  );
  const resources = await resourcesOfBad();
  for (const { url: resourceUrl, state, error, tries, loadedBytes, totalBytes } of resources) {
    const isDamaged = url.endsWith(resourceUrl.replace(/^\.?\//, ""));
    assert.deepEqual([state, error !== null], isDamaged ? ["failed", true] : ["ready", false], resourceUrl);
    assert.equal(tries, view.server.requests.filter(({ path }) => path === `/${resourceUrl}`).length, resourceUrl);
    assert.equal(loadedBytes, totalBytes, resourceUrl);
  }
  assert.ok(resources.length > 1);
  assert.equal((await view.events("load", "shape#good")).length, 1);
  assert.deepEqual(await view.events("load", "shape#bad"), []);
}

/** The picture of #good alone. */
const pictureOfGood = () => pictureOfSite(siteOfGenerated("trefoil", "--profile", "classic"));

describe("a missing file", () => {
  test("does not affect the other shape if its own shape cannot be displayed without it", async () => {
    await withFault(0, { status: 404 }, async (view, url) => {
      await assertReported(view, url);
      assertSamePicture("without the bad shape", await view.picture(), await pictureOfGood(), { mean: 0 });
    });
  });

  soakTest("limits the precision of its shape to that of the other files", async () => {
    await withFault(4, { status: 404 }, async (view, url) => {
      await assertReported(view, url);
      assert.ok(difference(await view.picture(), await pictureOfGood()).mean > 1, "the coarse shape is not visible");
    });
  });

  test("is requested again after a temporary status", async () => {
    await withFault(2, { status: 503 }, async (view, url) => {
      await assertReported(view, url);
      assert.ok(view.server.requests.filter(({ path }) => url.endsWith(path)).length > 1);
    });
  });

  soakTest("does not stop the page from following the document and the keyboard", async () => {
    await withFault(1, { status: 404 }, async (view) => {
      const before = await view.picture();
      await view.page.evaluate(() => {
        document.querySelector("#good material")!.setAttribute("diffuseColor", "1 0 0");
      });
      const red = await view.picture();
      assert.ok(difference(before, red).mean > 0.5, "the document is not followed");
      await view.page.keyboard.press("Tab");
      await view.page.keyboard.press("+");
      assert.ok(difference(red, await view.picture()).mean > 0.5, "the keyboard is not followed");
    });
  });
});

const smallestJpeg =
  "/9j/4AAQSkZJRgABAQEASABIAAD/2wBDAP//////////////////////////////////////////////////////////////////////" +
  "////////////////wgALCAABAAEBAREA/8QAFBABAAAAAAAAAAAAAAAAAAAAAP/aAAgBAQABPxA=";
const smallestWebp = "UklGRiIAAABXRUJQVlA4IBYAAAAwAQCdASoBAAEADsD+JaQAA3AAAAAA";

describe("a damaged file is reported", () => {
  const sample = new Set(["an image of another size", "an image with flipped bits"]);
  const broken: Record<string, Behaviour> = {
    "a truncated image": { truncateTo: 200 },
    "an empty image": { truncateTo: 0 },
    "a lossy image: JPEG": { replace: () => Buffer.from(smallestJpeg, "base64") },
    "a lossy image: WebP": { replace: () => Buffer.from(smallestWebp, "base64") },
    "an image of another size": {
      replace: () => encodePng({ width: 16, height: 16, channels: 3, data: new Uint8Array(768) }),
    },
    // Mesa's llvmpipe takes 16,384 texels, SwiftShader 8192, and no GPU more than 32,768.
    "an image that exceeds the maximum texture size": {
      replace: () => encodePng({ width: 32_769, height: 1, channels: 3, data: new Uint8Array(32_769 * 3) }),
    },
    "no image at all": { replace: () => "<!doctype html><p>Not found</p>" },
    "an image with flipped bits": {
      replace: (body) => Buffer.from(body.map((byte, i) => (i > 100 && i % 50 === 0 ? byte ^ 255 : byte))),
    },
  };
  for (const [name, behaviour] of Object.entries(broken)) {
    (sample.has(name) ? test : soakTest)(name, async () => {
      await withFault(0, behaviour, async (view, url) => {
        await assertReported(view, url);
        assertSamePicture(`broken ${name}`, await view.picture(), await pictureOfGood(), { mean: 0 });
      });
    });
  }
});
