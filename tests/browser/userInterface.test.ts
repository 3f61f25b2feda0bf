// Tests the user interface around the picture: attributes of <x3d>, poster, progress bar, and access by keyboard
// and screen reader.

import assert from "node:assert/strict";
import { describe, test } from "node:test";
import type { ViewElement } from "../../web/src/dom/imgeoView.ts";
import { assertSamePicture, difference } from "./compare.ts";
import { center, drag, focusView } from "./gestures.ts";
import { screenshotOf, settle, until, withPage, type PageOptions, type View } from "./harness.ts";
import { soakTest } from "./soak.ts";
import { viewEvents, recordViewEvents } from "./viewEvents.ts";
import { decodePng } from "./png.ts";
import { gate } from "./server.ts";
import { ranksOfFiles } from "./siteDecoder.ts";
import { pageOf, siteOfGenerated, variantOf } from "./sites.ts";
import { assertNear, siteWith, withScene } from "./viewSites.ts";

async function orbitOf({ page }: View): Promise<{ theta: number; phi: number; radius: number }> {
  return page.evaluate(() => {
    const { theta, phi, radius } = document.querySelector<ViewElement>("x3d")!.getCameraOrbit();
    return { theta, phi, radius };
  });
}

describe("attributes of <x3d>", () => {
  test("position the camera, at the start and when they change", async () => {
    await withScene(
      siteWith("orbit", { attributes: 'camera-orbit="30deg 60deg 9m" camera-target="1m 0m 0m"' }),
      {},
      async (view) => {
        const { theta, phi, radius } = await orbitOf(view);
        assertNear(theta, Math.PI / 6);
        assertNear(phi, Math.PI / 3);
        assertNear(radius, 9);
        await focusView(view);
        await view.page.keyboard.press("ArrowLeft");
        assert.ok(Math.abs((await orbitOf(view)).theta - theta) > 0.01);
        await view.page.keyboard.press("r");
        assertNear((await orbitOf(view)).theta, theta);
        await view.page.evaluate(() => {
          document.querySelector("x3d")!.setAttribute("camera-orbit", "-1rad auto auto");
        });
        await settle(view.page);
        assertNear((await orbitOf(view)).theta, -1);
        const text = await view.page.evaluate(() =>
          String(document.querySelector<ViewElement>("x3d")!.getCameraOrbit()),
        );
        assert.match(text, /^-[\d.]+rad [\d.]+rad [\d.]+m$/);
      },
    );
  });

  soakTest("limit the orbit of the camera and set its field of view", async () => {
    await withScene(
      siteWith("bounds", { attributes: 'max-camera-orbit="auto 80deg auto" min-camera-orbit="auto auto 100%"' }),
      {},
      async (view) => {
        await drag(view, 0, -300);
        assertNear((await orbitOf(view)).phi, (80 * Math.PI) / 180);
        const { radius } = await orbitOf(view);
        for (let i = 0; i < 9; ++i) await view.page.mouse.wheel(0, -240);
        await settle(view.page);
        const { radius: nearest } = await orbitOf(view);
        assert.ok(nearest <= radius && nearest > radius / 3);
        const before = await view.picture();
        await view.page.evaluate(() => {
          document.querySelector("x3d")!.setAttribute("field-of-view", "80deg");
        });
        assert.ok(difference(before, await view.picture()).mean > 1);
      },
    );
  });

  test("switch the camera's controls off, and on again", async () => {
    await withScene(siteWith("still", { attributes: 'camera-controls="false"' }), {}, async (view) => {
      const start = await view.picture();
      await drag(view, 90, 40);
      await view.page.mouse.wheel(0, 240);
      await view.page.keyboard.press("Tab");
      assert.equal(await view.page.evaluate(() => document.activeElement?.localName), "body");
      assertSamePicture("camera-controls off", await view.picture(), start, { mean: 0 });
      assert.equal(await view.page.getByRole("img").count(), 1);
      await view.page.evaluate(() => {
        document.querySelector("x3d")!.setAttribute("camera-controls", "");
      });
      await drag(view, 90, 40);
      assert.ok(difference(start, await view.picture()).mean > 1);
    });
  });

  test("leave wheel and touch gestures to the page if set", async () => {
    const site = siteWith("scrolls", {
      attributes: 'disable-zoom touch-action="pan-y"',
      after: '<div id="tall"></div>',
    });
    const tall = (): void => {
      const sheet = new CSSStyleSheet();
      sheet.replaceSync(
        "#tall { height: 3000px } html, body { height: auto !important; overflow: auto !important } x3d { height: 480px !important }",
      );
      document.adoptedStyleSheets.push(sheet);
    };
    await withScene(site, {}, async (view) => {
      await view.page.evaluate(tall);
      const before = await orbitOf(view);
      await view.page.mouse.move(center.x, center.y);
      await view.page.mouse.wheel(0, 300);
      await until("the page scrolls", async () => (await view.page.evaluate(() => scrollY)) > 100);
      assert.deepEqual(await orbitOf(view), before);
      assert.equal(
        await view.page.evaluate(
          () =>
            getComputedStyle(document.querySelector("imgeo-view")!.shadowRoot!.querySelector("canvas")!).touchAction,
        ),
        "pan-y",
      );
    });
  });

  soakTest("leave touch gestures to a page that scrolls, until the view has the focus", async () => {
    const touchAction = (view: View): Promise<string> =>
      view.page.evaluate(
        () => getComputedStyle(document.querySelector("imgeo-view")!.shadowRoot!.querySelector("canvas")!).touchAction,
      );
    await withScene(siteWith("scrolls-by-itself", { after: '<div id="tall"></div>' }), {}, async (view) => {
      assert.equal(await touchAction(view), "none"); // there is nothing to scroll
      await view.page.evaluate(() => {
        const sheet = new CSSStyleSheet();
        sheet.replaceSync(
          "#tall { height: 3000px } html, body { height: auto !important; overflow: auto !important } x3d { height: 480px !important }",
        );
        document.adoptedStyleSheets.push(sheet);
      });
      await until("the page may scroll", async () => (await touchAction(view)) === "pan-y");
      await focusView(view);
      assert.equal(await touchAction(view), "none");
      await view.page.keyboard.press("Escape");
      assert.equal(await touchAction(view), "pan-y");
    });
  });

  test("that are malformed are named on the console and change nothing", async () => {
    const lines: string[] = [];
    await withPage(siteWith("malformed", { attributes: 'camera-orbit="left" exposure="high"' }), {}, async (view) => {
      view.page.on("console", (message) => lines.push(message.text()));
      await view.promise("complete");
      await view.picture();
    });
    assert.equal(lines.filter((line) => line.includes('camera-orbit="left"')).length, 1);
  });

  soakTest("set the exposure", async () => {
    await withScene(siteOfGenerated("trefoil", "--profile", "classic"), {}, async (view) => {
      const before = await view.picture();
      await view.page.evaluate(() => {
        document.querySelector("x3d")!.setAttribute("exposure", "0.5");
      });
      const after = await view.picture();
      // The exposure does not change the sky.
      const isScene = (at: number): boolean => before.data[at] !== before.data[at % before.channels];
      const ratios = Array.from(after.data, (byte, at) => (isScene(at) ? byte / before.data[at]! : NaN))
        .filter((ratio) => !Number.isNaN(ratio))
        .sort((a, b) => a - b);
      assertNear(ratios[Math.floor(ratios.length / 2)]!, 0.5, 0.01);
      await view.page.evaluate(() => {
        document.querySelector("x3d")!.removeAttribute("exposure");
      });
      assertSamePicture("exposure back", await view.picture(), before, { mean: 0 });
    });
  });
});

describe("auto-rotation", () => {
  const attributes = 'auto-rotate auto-rotate-delay="50" rotation-per-second="90deg"';

  test("begins after the delay, pauses while the user moves the camera, and stops on pause()", async () => {
    await withPage(siteWith("turns", { attributes }), { before: recordViewEvents, motion: true }, async (view) => {
      await view.promise("complete");
      await until("the scene rotates", async () =>
        (await viewEvents(view, "camera-change")).some(({ detail }) => detail.source === "automatic"),
      );
      assert.equal(await view.page.evaluate(() => document.querySelector<ViewElement>("x3d")!.paused), false);
      await view.page.evaluate(() => {
        document.querySelector<ViewElement>("x3d")!.pause();
      });
      await settle(view.page);
      const { theta } = await orbitOf(view);
      await view.page.evaluate(() => {
        document.querySelector<ViewElement>("x3d")!.play();
      });
      await until("the scene continues to rotate", async () => Math.abs((await orbitOf(view)).theta - theta) > 0.01);
      await view.page.evaluate(() => {
        document.querySelector("x3d")!.removeAttribute("auto-rotate");
      });
      await settle(view.page);
      assert.ok(await view.page.evaluate(() => document.querySelector<ViewElement>("x3d")!.paused));
    });
  });

  test("does not start with reduced motion, except on play()", async () => {
    await withScene(siteWith("turns", { attributes }), {}, async (view) => {
      await view.page.evaluate(() => new Promise((resolve) => setTimeout(resolve, 300)));
      assert.ok((await viewEvents(view, "camera-change")).every(({ detail }) => detail.source !== "automatic"));
      await view.page.evaluate(() => {
        document.querySelector<ViewElement>("x3d")!.play();
      });
      await until("the scene rotates", async () =>
        (await viewEvents(view, "camera-change")).some(({ detail }) => detail.source === "automatic"),
      );
      await view.page.evaluate(() => {
        document.querySelector<ViewElement>("x3d")!.pause();
      });
    });
  });
});

describe("a poster", () => {
  const isPosterVisible = async ({ page }: View): Promise<boolean> =>
    page.evaluate(() =>
      document.querySelector("imgeo-view")!.shadowRoot!.querySelector<HTMLElement>(".poster")!.checkVisibility(),
    );
  const geometry = (path: string): boolean => path.startsWith("/geometry/");

  test("is displayed until the first picture", async () => {
    const { closed, open } = gate();
    const site = siteWith("poster", { attributes: 'poster="poster.png" alt="A knot"' });
    const server: PageOptions["server"] = (server) => {
      server.when(geometry, { hold: closed });
      server.put("/poster.png", redPng());
    };
    await withPage(site, { server, before: recordViewEvents }, async (view) => {
      await until("the poster is displayed", async () => isRed(view));
      assert.equal(await view.page.getByRole("img", { name: "A knot" }).count(), 1);
      assert.deepEqual(await viewEvents(view, "poster-dismissed"), []);
      open();
      await view.promise("complete");
      assert.equal(await isPosterVisible(view), false);
      const types = (await viewEvents(view)).map(({ type }) => type).filter((type) => type !== "camera-change");
      assert.deepEqual(types, ["poster-dismissed", "model-visibility"]);
    });
  });

  test("with reveal=manual is displayed until the page dismisses it, also one in the slot", async () => {
    const site = siteWith("manual", { attributes: 'reveal="manual"', inside: '<p slot="poster">Wait for it</p>' });
    await withScene(site, {}, async (view) => {
      await settle(view.page);
      assert.ok(await isPosterVisible(view));
      assert.ok(await view.page.getByText("Wait for it").isVisible());
      assert.deepEqual(await viewEvents(view, "model-visibility"), []);
      await view.page.evaluate(() => {
        document.querySelector<ViewElement>("x3d")!.dismissPoster();
      });
      assert.equal(await isPosterVisible(view), false);
      assert.deepEqual(
        (await viewEvents(view, "model-visibility")).map(({ detail }) => detail),
        [{ visible: true }],
      );
      await view.page.evaluate(() => {
        document.querySelector<ViewElement>("x3d")!.dismissPoster();
      });
      assert.equal((await viewEvents(view, "poster-dismissed")).length, 1);
    });
  });

  const isRed = async ({ page }: View): Promise<boolean> => {
    const { data, width, channels } = await screenshotOf(page);
    const at = (center.y * width + center.x) * channels;
    return data[at]! > 200 && data[at + 1]! < 50;
  };
});

/** One red pixel. */
function redPng(): Buffer {
  return Buffer.from(
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGP4z8AAAAMBAQDJ/pLvAAAAAElFTkSuQmCC",
    "base64",
  );
}

describe("loading", () => {
  const below = (loading: string): string =>
    variantOf(siteOfGenerated("trefoil", "--profile", "classic"), `below-${loading}`, (page) =>
      page.replace(/<link rel="preload"[^>]*>/g, "").replace(/<X3D/i, `<div id="tall"></div><X3D loading="${loading}"`),
    );
  const tall = (): void => {
    const sheet = new CSSStyleSheet();
    sheet.replaceSync(
      "#tall { height: 6000px } html, body { height: auto !important; overflow: auto !important } x3d { height: 400px !important }",
    );
    document.adoptedStyleSheets.push(sheet);
  };

  for (const loading of ["auto", "lazy"]) {
    test(`="${loading}" defers a scene far below the viewport until it comes near`, async () => {
      await withPage(below(loading), { before: tall }, async (view) => {
        await until("the runtime runs", async () =>
          view.page.evaluate(
            () =>
              document.querySelector("imgeo-view")?.shadowRoot !== null &&
              document.querySelector("imgeo-view") !== null,
          ),
        );
        await view.page.evaluate(() => new Promise((resolve) => setTimeout(resolve, 300)));
        assert.equal(view.server.requestsOf(/geometry/).length, 0);
        await view.page.evaluate(() => {
          document.querySelector("x3d")!.scrollIntoView();
        });
        await view.promise("complete");
        await view.promise("complete", "shape");
      });
    });
  }

  test('="eager" does not wait', async () => {
    await withPage(below("eager"), { before: tall }, async (view) => {
      await until(
        "all files are requested",
        () =>
          view.server.requestsOf(/geometry/).length ===
          ranksOfFiles(pageOf(siteOfGenerated("trefoil", "--profile", "classic"))).size,
      );
    });
  });
});

describe("users of screen readers and keyboards", () => {
  test("get the label, the keys and a description of the view", async () => {
    await withScene(siteWith("named", { attributes: 'alt="A trefoil knot in stone"' }), {}, async (view) => {
      const canvas = view.page.getByRole("application", { name: "A trefoil knot in stone" });
      assert.equal(await canvas.count(), 1);
      assert.match((await canvas.getAttribute("aria-description")) ?? "", /Arrow keys turn/);
      await focusView(view);
      await view.page.keyboard.press("ArrowRight");
      await until("the view is described", async () =>
        ((await view.page.getByRole("status").textContent()) ?? "").startsWith("View from"),
      );
      await view.page.keyboard.press("r");
      await until(
        "the viewpoint is named",
        async () => (await view.page.getByRole("status").textContent()) === "Start",
      );
      await view.page.evaluate(() => {
        document.querySelector("x3d")!.setAttribute("alt", "Another name");
      });
      await until(
        "the name follows",
        async () => (await view.page.getByRole("application", { name: "Another name" }).count()) === 1,
      );
    });
  });

  test("get the loading progress", async () => {
    const { closed, open } = gate();
    await withPage(
      siteOfGenerated("trefoil", "--profile", "classic"),
      {
        server: (server) => {
          server.when((path) => path.startsWith("/geometry/"), { hold: closed });
          // The page has been drawn once before it knows which files it needs.
          server.when((path) => /imgeo-[a-z]+-[0-9a-f]{16}\.js$/.test(path), { delayMs: 400 });
        },
      },
      async (view) => {
        const bar = view.page.getByRole("progressbar", { name: "Loading" });
        await until("files are requested", async () =>
          view.page.evaluate(() => {
            const { resources } = document.querySelector<HTMLElement & { resources?: unknown[] }>("x3d")!;
            return resources !== undefined && resources.length > 0;
          }),
        );
        await settle(view.page);
        assert.equal(await bar.count(), 1);
        assert.deepEqual(
          [
            await bar.getAttribute("aria-valuemin"),
            await bar.getAttribute("aria-valuenow"),
            await bar.getAttribute("aria-valuemax"),
          ],
          ["0", "0", "100"],
        );
        open();
        await view.promise("complete");
        await settle(view.page);
        assert.equal(await bar.count(), 0); // a complete scene is not announced as loading
        assert.equal(await view.page.getByRole("status").textContent(), "The scene is complete.");
      },
    );
  });

  test("see the focus, and leave the view by Tab or Escape", async () => {
    const site = siteWith("between", {
      before: '<a id="first" href="#">Before</a>',
      after: '<a id="last" href="#">Behind</a>',
    });
    await withScene(site, {}, async (view) => {
      const focused = async (): Promise<string> =>
        view.page.evaluate(() => document.activeElement?.id ?? document.activeElement?.localName ?? "");
      const unfocused = await view.picture();
      await view.page.keyboard.press("Tab");
      assert.equal(await focused(), "first");
      await view.page.keyboard.press("Tab");
      assert.equal(await view.page.evaluate(() => document.activeElement?.localName), "imgeo-view");
      assert.ok(difference(unfocused, await view.picture()).mean > 0.3, "the focus is not visible");
      await view.page.keyboard.press("Tab");
      assert.equal(await focused(), "last");
      await view.page.keyboard.press("Shift+Tab");
      await view.page.keyboard.press("Escape");
      assert.equal(await view.page.evaluate(() => document.activeElement?.localName), "body");
      await view.page.keyboard.press("Tab"); // continues after the view
      assert.equal(await focused(), "last");
    });
  });
});

test("a page replaces the progress bar by the slot", async () => {
  await withPage(siteWith("own-bar", { inside: '<p slot="progress-bar" id="own">…</p>' }), {}, async (view) => {
    await view.promise("complete");
    assert.ok(await view.page.locator("#own").isVisible());
    assert.equal(await view.page.getByRole("progressbar").count(), 0);
  });
});

test("toBlob returns the picture as a file", async () => {
  await withScene(siteOfGenerated("trefoil", "--profile", "classic"), {}, async (view) => {
    const shown = await view.picture();
    const bytes = await view.page.evaluate(async () => {
      const blob = await document.querySelector<ViewElement>("x3d")!.toBlob();
      return [blob.type, Array.from(new Uint8Array(await blob.arrayBuffer()))] as const;
    });
    assert.equal(bytes[0], "image/png");
    assertSamePicture("toBlob", decodePng(Buffer.from(bytes[1])), shown, { mean: 0.001 });
  });
});
