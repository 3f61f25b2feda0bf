// Tests basic behaviour of the view: rotating, zooming, resizing, events, promises, and drawing no frames while
// nothing changes.

import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { assertSamePicture, boundsOfQuantised, difference } from "./compare.ts";
import { center, coveredPixelCount, focusView, touch } from "./gestures.ts";
import { settle, until, withPage, type PageOptions, type View } from "./harness.ts";
import type { Picture } from "./png.ts";
import { referencePicture } from "./reference.ts";
import { gate } from "./server.ts";
import { decodeSite, ranksOfFiles } from "./siteDecoder.ts";
import { pageOf, siteOfGenerated, variantOf } from "./sites.ts";
import { isSoak, soakTest } from "./soak.ts";

const site = (): string => siteOfGenerated("trefoil-colors", "--profile", "classic");

async function withCompletePage(options: PageOptions, use: (view: View) => Promise<void>): Promise<void> {
  await withPage(site(), options, async (view) => {
    await view.promise("complete");
    await use(view);
  });
}

const gestures: Record<string, (view: View) => Promise<void>> = {
  "the arrow keys with Shift": async ({ page }) => {
    for (let i = 0; i < 3; ++i) await page.keyboard.press("Shift+ArrowRight");
  },
  "the arrow keys": async ({ page }) => {
    for (const key of ["ArrowLeft", "ArrowLeft", "ArrowUp"]) await page.keyboard.press(key);
  },
  "the plus key": async ({ page }) => page.keyboard.press("+"),
  "the minus key": async ({ page }) => page.keyboard.press("-"),
  "dragging the mouse": async ({ page }) => {
    await page.mouse.move(center.x, center.y);
    await page.mouse.down();
    await page.mouse.move(center.x + 90, center.y + 40, { steps: 5 });
    await page.mouse.up();
  },
  "dragging with the right button": async ({ page }) => {
    await page.mouse.move(center.x, center.y);
    await page.mouse.down({ button: "right" });
    await page.mouse.move(center.x + 60, center.y - 30, { steps: 5 });
    await page.mouse.up({ button: "right" });
  },
  "turning the wheel": async ({ page }) => {
    await page.mouse.move(center.x, center.y);
    await page.mouse.wheel(0, 240);
  },
};

describe("the camera moves, and R resets it", () => {
  test("by keys and by the mouse", async (context) => {
    await withCompletePage({}, async (view) => {
      await focusView(view);
      const before = await view.picture();
      for (const [name, gesture] of Object.entries(gestures)) {
        if (!isSoak && !/arrow keys$|mouse|wheel/.test(name)) continue;
        await context.test(name, async () => {
          await gesture(view);
          const after = await view.picture();
          assert.ok(difference(before, after).mean > 1, `moved by ${difference(before, after).mean}`);
          await view.page.keyboard.press("r");
          assertSamePicture(`reset after ${name}`, await view.picture(), before, { mean: 0.001 });
        });
      }
    });
  });

  test("two fingers zoom, and one finger rotates", async () => {
    await withCompletePage({ hasTouch: true }, async (view) => {
      const before = await view.picture();
      await touch(view, [
        [
          [-40, 0],
          [40, 0],
        ],
        [
          [-60, 0],
          [60, 0],
        ],
        [
          [-90, 0],
          [90, 0],
        ],
      ]);
      const nearer = await view.picture();
      assert.ok(coveredPixelCount(nearer) > 1.3 * coveredPixelCount(before), "two fingers do not zoom in");
      await touch(view, [[[0, 0]], [[40, 10]], [[90, 20]]]);
      assert.ok(difference(nearer, await view.picture()).mean > 1, "one finger does not turn");
    });
  });
});

describe("the picture fits its element", () => {
  test("after the window has been resized", async () => {
    const size = { width: 420, height: 600 };
    await withCompletePage({}, async (view) => {
      await view.page.setViewportSize(size);
      await until("the canvas has the new size", () =>
        view.page.evaluate(
          (width) => document.querySelector("imgeo-view")!.shadowRoot!.querySelector("canvas")!.width === width,
          size.width,
        ),
      );
      const expected = await referencePicture(pageOf(site()), decodeSite(site()), size);
      assertSamePicture("resized", await view.picture(), expected, boundsOfQuantised);
    });
  });

  soakTest("with a device pixel ratio of 2", async () => {
    const size = { width: 320, height: 240 };
    await withCompletePage({ size, deviceScaleFactor: 2 }, async (view) => {
      const picture = await view.picture();
      assert.deepEqual([picture.width, picture.height], [640, 480]);
      const expected = await referencePicture(pageOf(site()), decodeSite(site()), size, 2);
      assertSamePicture("double resolution", picture, expected, boundsOfQuantised);
    });
  });
});

test("nothing is drawn while nothing changes", async () => {
  await withCompletePage({}, async (view) => {
    await settle(view.page);
    const { draws } = await view.observed();
    await view.page.evaluate(() => new Promise((resolve) => setTimeout(resolve, 1000)));
    assert.equal((await view.observed()).draws, draws);
    await focusView(view);
    await view.page.keyboard.press("ArrowLeft");
    await until("a key causes a frame", async () => (await view.observed()).draws > draws);
  });
});

describe("events", () => {
  test("report the loading of the scene and each shape, in order, and do not bubble, and promises resolve", async () => {
    // Files for refinement are held until the first picture; otherwise there might be no refinement.
    const { closed, open } = gate();
    const later = [...ranksOfFiles(pageOf(site()))].filter(([, rank]) => rank > 0).map(([url]) => `/${url}`);
    await withPage(
      site(),
      { server: (server) => void server.when((path) => later.includes(path), { hold: closed }) },
      async (view) => {
        for (const selector of ["x3d", "shape"]) await view.promise("firstImage", selector);
        open();
        for (const selector of ["x3d", "shape"]) await view.promise("complete", selector);
        await settle(view.page);
        const { events, bubbled } = await view.observed();
        assert.deepEqual(bubbled, []);
        assert.ok(events.every(({ bubbles }) => !bubbles));
        for (const target of ["x3d", "shape"]) {
          const own = events.filter((event) => event.target === target);
          const types = own.map(({ type }) => type).filter((type) => type !== "progress");
          assert.equal(types[0], "first-image");
          assert.equal(types.at(-1), "load");
          assert.ok(types.includes("refine"));
          assert.equal(types.filter((type) => type === "load" || type === "first-image").length, 2);
          assertProgress(own.filter(({ type }) => type === "progress").map(({ detail }) => detail));
        }
      },
    );
  });

  function assertProgress(details: Record<string, unknown>[]): void {
    const shares = details.map(({ totalProgress }) => Number(totalProgress));
    assert.ok(shares.length > 1);
    assert.equal(shares.at(-1), 1);
    shares.forEach((share, index) => {
      assert.ok(share >= (shares[index - 1] ?? 0) && share <= 1, `progress ${shares.join(" ")}`);
    });
    for (const { loadedBytes, totalBytes, stage } of details) {
      assert.ok(Number(loadedBytes) >= 0 && Number(totalBytes) > 0, `${String(loadedBytes)} of ${String(totalBytes)}`);
      assert.equal(typeof stage, "string");
    }
  }
});

test("a browser without WebGL2 gets a message", async () => {
  const before = (): void => {
    HTMLCanvasElement.prototype.getContext = () => null;
    OffscreenCanvas.prototype.getContext = () => null;
  };
  await withPage(site(), { before, expectedErrors: /WebGL/ }, async (view) => {
    await until("the message is displayed", async () => /WebGL ?2/.test(await shownText(view)));
    assert.ok(
      (await view.picture()).data.some((byte, i, data) => byte !== data[i % 3]),
      "nothing is visible",
    );
  });
});

/** The text of the view, in its shadow root. */
async function shownText({ page }: View): Promise<string> {
  return page.evaluate(() => document.querySelector("imgeo-view")?.shadowRoot?.textContent ?? "");
}

test("programs are compiled while the first files are loading", async () => {
  const { closed, open } = gate();
  const before = (): void => {
    const counts = { links: 0 };
    Object.assign(window, { counts });
    const gl = WebGL2RenderingContext.prototype as unknown as Record<string, (...args: unknown[]) => void>;
    const link = gl.linkProgram;
    gl.linkProgram = function (...args) {
      counts.links += 1;
      link?.apply(this, args);
    };
  };
  await withPage(
    site(),
    { before, server: (server) => server.when(/^\/geometry\//, { hold: closed }) },
    async (view) => {
      const links = (): Promise<number> =>
        view.page.evaluate(() => (window as unknown as { counts: { links: number } }).counts.links);
      // Points, flat shading, shading by normals, and the same with colours.
      await until("four programs are being compiled", async () => (await links()) === 4);
      open();
      await view.promise("complete");
      // The test of the GPU uses one more, and colours that have been decoded before the normals another one.
      assert.ok((await links()) <= 6, `${await links()} programs`);
    },
  );
});

soakTest("a shape without a box in the document is framed when its vertices have loaded", async () => {
  const whole = siteOfGenerated("trefoil", "--container", "bg", "--coord-type", "float32");
  const withoutViewpoint = (page: string): string => page.replace(/<Viewpoint[^>]*><\/Viewpoint>/i, "");
  const withoutBoxes = (page: string): string => withoutViewpoint(page).replaceAll(/\sbbox(Center|Size)="[^"]*"/gi, "");
  const pictures: Picture[] = [];
  for (const [name, change] of Object.entries({ withoutViewpoint, withoutBoxes })) {
    await withPage(variantOf(whole, name, change), {}, async (view) => {
      await view.promise("complete");
      pictures.push(await view.picture());
    });
  }
  assert.ok(coveredPixelCount(pictures[0]!) > 20_000);
  assertSamePicture("without boxes", pictures[1]!, pictures[0]!, { mean: 0.1 });
});
