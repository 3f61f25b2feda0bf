// Tests the preview: it equals the picture that the runtime draws of the same base, it follows the document, and the
// change to the runtime is not visible.

import assert from "node:assert/strict";
import { test } from "node:test";
import { difference, silhouette, silhouetteDifference } from "./compare.ts";
import { screenshotOf, until, withPage, type View } from "./harness.ts";
import { decodePng, type Picture } from "./png.ts";
import { gate } from "./server.ts";
import { tagsOf } from "./siteDecoder.ts";
import { pageOf, siteOfGenerated, siteOfRelief } from "./sites.ts";
import { soakTest } from "./soak.ts";

declare global {
  interface Window {
    /** What the view's own canvas displayed when the preview had ended. */
    takenOver: string | undefined;
    /** The programs with which the preview draws bases: how many had drawn something before, and how many had not. */
    warmedUp: { ready: number; unready: number };
    /** Ends the page's wait for bases. */
    endWait: (() => void) | undefined;
    /** Ends the preview's wait for patches that arrive at once. */
    endWaitForPatches: (() => void) | undefined;
  }
}

/** A closed surface of several patches, with a base. */
const site = (): string => siteOfGenerated("trefoil-large", "--profile", "compact", "--patch-vertices", "20000");

/** A mesh with levels of detail, of which the view needs groups of all of them. */
const leveledSite = (): string => siteOfRelief(60_000, "--levels", "always", "--group-triangles", "1024");

/** Runs in the page: records the programs with which the preview draws, and the view's canvas when the preview ends. */
function watchPreview(): void {
  const later = window.setTimeout.bind(window);
  window.setTimeout = ((call: () => void, ms?: number, ...args: unknown[]) => {
    if (ms !== 3000) return later(call, ms, ...args);
    window.endWait = call; // on a busy machine it could end before what it waits for
    return 0;
  }) as typeof setTimeout;
  const [warmUpPrograms, basePrograms] = [new Set<unknown>(), new Set<unknown>()];
  const drawElements = Object.getOwnPropertyDescriptor(WebGL2RenderingContext.prototype, "drawElements")?.value as (
    ...args: unknown[]
  ) => void;
  WebGL2RenderingContext.prototype.drawElements = function (...args) {
    if (this.canvas instanceof HTMLCanvasElement && this.canvas.classList.contains("preview")) {
      (args[1] > 3 ? basePrograms : warmUpPrograms).add(this.getParameter(this.CURRENT_PROGRAM));
      const ready = Array.from(basePrograms).filter((program) => warmUpPrograms.has(program)).length;
      window.warmedUp = { ready, unready: basePrograms.size - ready };
    }
    drawElements.apply(this, args);
  };
  const prototype = Element.prototype as unknown as Record<
    "attachShadow",
    (this: Element, init: ShadowRootInit) => ShadowRoot
  >;
  const { attachShadow } = prototype;
  prototype.attachShadow = function (init) {
    const root = attachShadow.call(this, init);
    // Called in the task in which the preview is removed, so the canvas can still be read.
    new MutationObserver((records) => {
      const isPreview = (node: Node): boolean => node instanceof Element && node.classList.contains("preview");
      if (records.some(({ removedNodes }) => Array.from(removedNodes).some(isPreview)))
        window.takenOver = root.querySelector("canvas")?.toDataURL();
    }).observe(root, { childList: true });
    return root;
  };
}

const firstImages = async (view: View): Promise<number> => (await view.events("first-image", "x3d")).length;

/** Waits until the preview has followed the last change. */
async function pictureAfter(view: View, change: () => Promise<unknown>): Promise<Picture> {
  const { draws } = await view.observed();
  await change();
  await until("the preview has followed", async () => (await view.observed()).draws > draws);
  return screenshotOf(view.page);
}

async function pictureOfTakeOver(view: View): Promise<Picture> {
  await until("the runtime has taken over", async () => view.page.evaluate(() => window.takenOver !== undefined));
  const url = await view.page.evaluate(() => window.takenOver ?? "");
  return decodePng(Buffer.from(url.slice(url.indexOf(",") + 1), "base64"));
}

/** The preview's canvases, and the frames that the runtime has drawn. */
async function previewAndFrames({ page }: View): Promise<{ previews: number; frames: number | undefined }> {
  return page.evaluate(() => {
    const view = document.querySelector("imgeo-view") as unknown as Element & { statistics?: { frames: number } };
    const previews = view.shadowRoot?.querySelectorAll("canvas.preview").length ?? 0;
    return { previews, frames: view.statistics?.frames };
  });
}

/** Makes the runtime draw, which ends the preview. */
async function pictureOfView({ page }: View): Promise<Picture> {
  const bytes = await page.evaluate(async () => {
    const x3d = document.querySelector("x3d") as unknown as { toBlob(): Promise<Blob> };
    return Array.from(new Uint8Array(await (await x3d.toBlob()).arrayBuffer()));
  });
  return decodePng(Buffer.from(bytes));
}

/** Runs in the page. */
function loseContext(): void {
  const canvas = document.querySelector("imgeo-view")?.shadowRoot?.querySelector<HTMLCanvasElement>("canvas.preview");
  canvas?.getContext("webgl2")?.getExtension("WEBGL_lose_context")?.loseContext();
}

const runtimeFile = /imgeo-scene-/;
/** Groups of levels but the root. */
const groupFile = /\/0\/[1-9]\d*\.png$/;

async function baseIsWaitedFor({ page, server }: View, base: string): Promise<void> {
  await until(
    "the preview waits for its base",
    async () =>
      server.requestsOf(new RegExp(base)).length === 1 && (await page.evaluate(() => window.endWait !== undefined)),
  );
  assert.deepEqual(server.requestsOf(runtimeFile), [], "the runtime is not requested before the base has arrived");
}

test("a preview displays the base before the runtime, which then displays the same", async () => {
  const tags = tagsOf(pageOf(site()));
  const base = tags.find(({ name }) => name === "imagegeometry")?.attributes.base ?? "";
  const patches = tags.flatMap(({ attributes: { data } }) => (data ? [data] : []));
  const [bases, runtime, files] = [gate(), gate(), gate()];
  const options = {
    size: { width: 400, height: 300 },
    deviceScaleFactor: 2,
    before: watchPreview,
    server: (server: View["server"]): void => {
      server.when(new RegExp(base), { hold: bases.closed });
      server.when(runtimeFile, { hold: runtime.closed });
      server.when((path) => patches.includes(path.slice(1)), { hold: files.closed });
    },
  };
  await withPage(site(), options, async (view) => {
    await baseIsWaitedFor(view, base);
    bases.open();
    await until("the preview has drawn", async () => (await firstImages(view)) === 1);
    assert.deepEqual(
      (await view.events("first-image")).map(({ target, detail }) => [target, detail.stage]),
      [
        ["shape", "base"],
        ["x3d", "base"],
      ],
    );
    assert.equal(view.server.requestsOf(runtimeFile)[0]?.status, 0, "the runtime is not here");
    const first = await screenshotOf(view.page);
    assert.deepEqual(await view.page.evaluate(() => window.warmedUp), { ready: 1, unready: 0 });

    const red = await pictureAfter(view, () =>
      view.page.evaluate(() => {
        document.querySelector("material")?.setAttribute("diffuseColor", "0.9 0.1 0.1");
      }),
    );
    assert.ok(difference(first, red).mean > 2, "another colour is displayed");
    const blank: Picture = { ...first, data: Uint8Array.from(first.data, (_, i) => first.data[i % first.channels]!) };
    assert.equal(silhouetteDifference(silhouette(first, blank), silhouette(red, blank)), 0);
    const lit = await pictureAfter(view, () =>
      view.page.evaluate(() => {
        const lights =
          '<PointLight location="2 2 4" color="0.2 0.5 0.2" attenuation="1 0.1 0"></PointLight>' +
          '<SpotLight location="0 0 6" direction="0 0 -1" color="0.2 0.2 0.6" cutOffAngle="0.3" beamWidth="0.1"></SpotLight>';
        document.querySelector("scene")?.insertAdjacentHTML("beforeend", lights);
      }),
    );
    assert.ok(difference(red, lit).mean > 1, "lights of other kinds are displayed");
    const displayed = await pictureAfter(view, () => view.page.setViewportSize({ width: 300, height: 320 }));
    assert.equal(displayed.width, 600);

    runtime.open();
    await until("the runtime has started", async () => (await previewAndFrames(view)).frames === 0);
    await view.page.waitForTimeout(300);
    assert.deepEqual(await previewAndFrames(view), { previews: 1, frames: 0 }, "nothing is drawn that is visible");
    await view.page.mouse.move(150, 160); // a visitor may change the view, which the preview cannot
    const taken = await pictureOfTakeOver(view);
    const empty: Picture = {
      ...displayed,
      data: Uint8Array.from(displayed.data, (_, i) => displayed.data[i % displayed.channels]!),
    };
    assert.ok(
      silhouetteDifference(silhouette(displayed, empty), silhouette(taken, empty)) < 1e-4,
      "the outline is the same",
    );
    assert.ok(
      difference(displayed, taken).mean < 0.1,
      `the runtime draws the same: ${JSON.stringify(difference(displayed, taken))}`,
    );

    files.open();
    await view.promise("complete");
    assert.equal(await firstImages(view), 1);
    assert.deepEqual((await view.events("refine", "x3d")).at(-1)?.detail.stage, "full");
    assert.equal(view.server.requestsOf(new RegExp(base)).length, 1);
    assert.equal(
      await view.page.evaluate(
        () => document.querySelector("imgeo-view")?.shadowRoot?.querySelectorAll("canvas").length,
      ),
      1,
    );
    const { resources } = await view.page.evaluate(() => {
      const { resources: all } = document.querySelector("x3d") as unknown as {
        resources: { url: string; state: string; tries: number }[];
      };
      return { resources: all.map(({ url, state, tries }) => ({ url, state, tries })) };
    });
    assert.deepEqual(
      resources.find(({ url }) => url === base),
      { url: base, state: "ready", tries: 1 },
    );
  });
});

/**
 * Asserts that the preview draws all of the scene when `files` are sent, with this event, and that the runtime, sent
 * after them, draws the same, and only when it must.
 */
async function assertDrawnBeforeRuntime(
  view: View,
  files: ReturnType<typeof gate>,
  runtime: ReturnType<typeof gate>,
  event: "first-image" | "refine",
): Promise<void> {
  const before = await screenshotOf(view.page);
  const full = await pictureAfter(view, () => {
    files.open();
    return Promise.resolve();
  });
  assert.deepEqual(
    (await view.events(event)).map(({ target, detail }) => [target, detail.stage]),
    [
      ["shape", "full"],
      ["x3d", "full"],
    ],
  );
  assert.ok((view.server.requestsOf(runtimeFile)[0]?.status ?? 0) === 0, "the runtime is not here");
  assert.ok(difference(before, full).mean > 0.05, "the files are seen");

  runtime.open();
  await view.promise("complete");
  await view.page.waitForTimeout(300); // a runtime that draws the same picture again does it by then
  assert.deepEqual(await previewAndFrames(view), { previews: 1, frames: 0 }, "the runtime need not draw the same");
  const { draws } = await view.observed();
  const own = await pictureOfView(view);
  assert.ok(difference(full, own).mean < 0.2, `the runtime draws the same: ${JSON.stringify(difference(full, own))}`);
  assert.ok((await view.observed()).draws > draws);
  assert.equal((await previewAndFrames(view)).previews, 0, "the preview ends when the runtime has drawn");
  assert.ok(difference(full, await screenshotOf(view.page)).mean < 0.2);
  assert.equal((await view.events("refine", "x3d")).length, event === "refine" ? 1 : 0, "no event is sent twice");
  assert.equal((await view.events("first-image", "x3d")).length, 1);
}

for (const { name, site: siteOf, hasBase, lineBitsPerSecond } of [
  {
    name: "a small scene",
    site: () => siteOfGenerated("sphere-large", "--profile", "compact"),
    hasBase: true,
  },
  {
    name: "a small scene without a base",
    site: () => siteOfGenerated("trefoil", "--profile", "compact"),
    hasBase: false,
  },
  { name: "a larger scene on a fast line", site, hasBase: true, lineBitsPerSecond: 50e6 },
]) {
  const sample = name === "a small scene" ? test : soakTest;
  sample(`a preview displays the patches of ${name} before the runtime, which then displays the same`, async () => {
    const tags = tagsOf(pageOf(siteOf()));
    assert.equal(
      tags.some(({ attributes: { base } }) => base !== undefined),
      hasBase,
    );
    const patches = tags.flatMap(({ attributes: { data } }) => (data ? [data.replace(/#.*/, "")] : []));
    const [runtime, files] = [gate(), gate()];
    const options = {
      size: { width: 400, height: 300 },
      before: watchPreview,
      lineBitsPerSecond,
      server: (server: View["server"]): void => {
        server.when(runtimeFile, { hold: runtime.closed });
        server.when((path) => patches.includes(path.slice(1)), { hold: files.closed });
      },
    };
    await withPage(siteOf(), options, async (view) => {
      if (hasBase) await until("the preview has drawn the base", async () => (await firstImages(view)) === 1);
      else await until("the patch is requested", () => view.server.requestsOf(new RegExp(patches[0] ?? "")).length > 0);
      await assertDrawnBeforeRuntime(view, files, runtime, hasBase ? "refine" : "first-image");
      for (const patch of patches) assert.equal(view.server.requestsOf(new RegExp(patch)).length, 1);
    });
  });
}

test("a preview displays the groups of levels that a view needs, and the runtime takes them over", async () => {
  const [runtime, files] = [gate(), gate()];
  const options = {
    size: { width: 400, height: 300 },
    before: watchPreview,
    lineBitsPerSecond: 50e6,
    server: (server: View["server"]): void => {
      server.when(runtimeFile, { hold: runtime.closed });
      server.when(groupFile, { hold: files.closed });
    },
  };
  await withPage(leveledSite(), options, async (view) => {
    await until("the preview has drawn the root", async () => (await firstImages(view)) === 1);
    await until("groups are requested", () => view.server.requestsOf(groupFile).length > 0);
    await assertDrawnBeforeRuntime(view, files, runtime, "refine");
    const paths = view.requestedPaths.filter((path) => path.startsWith("geometry/"));
    assert.ok(paths.length > 4);
    assert.equal(new Set(paths).size, paths.length, "each file is requested once");
  });
});

soakTest("a group that fails leaves the root of its mesh to the preview, and one error to the runtime", async () => {
  const options = {
    size: { width: 400, height: 300 },
    lineBitsPerSecond: 50e6,
    expectedErrors: /Failed to load resource|19\.png/,
    server: (server: View["server"]): void => {
      server.when(/\/0\/19\.png$/, { status: 404 }); // of level 0, and in the view
    },
  };
  await withPage(leveledSite(), options, async (view) => {
    await view.promise("complete");
    const stages = (await view.events("first-image", "x3d")).map(({ detail }) => detail.stage);
    assert.deepEqual(stages, ["base"]);
    assert.equal((await view.events("error", "shape")).length, 1);
    await until("the runtime has drawn what it has", async () => ((await previewAndFrames(view)).frames ?? 0) > 0);
    assert.equal((await previewAndFrames(view)).previews, 0);
  });
});

/** Runs in the page: holds the timer after which a preview no longer waits for patches. */
function holdWaitForPatches(): void {
  const later = window.setTimeout.bind(window);
  window.setTimeout = ((call: () => void, ms?: number, ...args: unknown[]) => {
    if (ms !== 400) return later(call, ms, ...args);
    window.endWaitForPatches = call;
    return 0;
  }) as typeof setTimeout;
}

for (const arePatchesLate of [false, true]) {
  const displayed = arePatchesLate ? "the base when they are late" : "them alone";
  soakTest(`where small patches arrive at once, a preview displays ${displayed}`, async () => {
    const small = siteOfGenerated("sphere-large", "--profile", "compact");
    const patches = tagsOf(pageOf(small)).flatMap(({ attributes: { data } }) =>
      data ? [data.replace(/#.*/, "")] : [],
    );
    const [runtime, files] = [gate(), gate()];
    const options = {
      before: holdWaitForPatches,
      lineBitsPerSecond: 1e9,
      server: (server: View["server"]): void => {
        server.when(runtimeFile, { hold: runtime.closed });
        server.when((path) => patches.includes(path.slice(1)), { hold: files.closed });
      },
    };
    await withPage(small, options, async (view) => {
      await until("the preview waits for patches", () =>
        view.page.evaluate(() => window.endWaitForPatches !== undefined),
      );
      if (arePatchesLate) {
        await view.page.evaluate(() => window.endWaitForPatches?.());
        await until("the preview has drawn the base", async () => (await firstImages(view)) === 1);
      }
      files.open();
      await until("the preview has drawn the patches", async () =>
        (await view.events(arePatchesLate ? "refine" : "first-image", "x3d")).some(
          ({ detail }) => detail.stage === "full",
        ),
      );
      const stages = (await view.events("first-image", "x3d")).map(({ detail }) => detail.stage);
      assert.deepEqual(stages, [arePatchesLate ? "base" : "full"]);
      const before = await screenshotOf(view.page);
      runtime.open();
      await view.promise("complete");
      assert.equal((await previewAndFrames(view)).previews, 1, "the runtime need not draw the same");
      assert.ok(difference(before, await pictureOfView(view)).mean < 0.2, "the runtime draws the same");
      for (const patch of patches) assert.equal(view.server.requestsOf(new RegExp(patch)).length, 1);
    });
  });
}

/** What ends the preview of a complete scene, and whether the picture stays the same. */
const endings: readonly [name: string, isSame: boolean, change: (page: View["page"]) => Promise<unknown>][] = [
  [
    "a camera that moves",
    false,
    (page) => page.evaluate(() => document.querySelector("x3d")?.setAttribute("camera-orbit", "1rad 1rad 4m")),
  ],
  [
    "another colour",
    false,
    (page) => page.evaluate(() => document.querySelector("material")?.setAttribute("diffuseColor", "0.9 0.1 0.1")),
  ],
  ["the loss of the preview's context", true, (page) => page.evaluate(loseContext)],
  ["a pointer over the view", true, (page) => page.mouse.move(200, 150)],
];

for (const [name, isSame, change] of endings) {
  (name === "a pointer over the view" ? test : soakTest)(
    `${name} ends the preview of a complete scene, and the runtime draws`,
    async () => {
      const options = { size: { width: 400, height: 300 }, before: watchPreview };
      await withPage(siteOfGenerated("sphere-large", "--profile", "compact"), options, async (view) => {
        await view.promise("complete");
        await view.page.waitForTimeout(300);
        assert.deepEqual(await previewAndFrames(view), { previews: 1, frames: 0 });
        const before = await screenshotOf(view.page);
        await change(view.page);
        const taken = await pictureOfTakeOver(view);
        assert.ok(difference(taken, await screenshotOf(view.page)).mean < 0.2, "the runtime's picture is seen");
        const { mean } = difference(before, taken);
        assert.ok(isSame ? mean < 0.2 : mean > 0.5, `the picture differs by ${mean}`);
        assert.equal((await previewAndFrames(view)).previews, 0);
      });
    },
  );
}

test("the runtime that arrives first starts when the preview has drawn the patches of a small scene", async () => {
  const workers = gate();
  const options = {
    size: { width: 400, height: 300 },
    before: watchPreview,
    server: (server: View["server"]): void => void server.when(/imgeo-worker-/, { hold: workers.closed }),
  };
  await withPage(siteOfGenerated("sphere-large", "--profile", "compact"), options, async (view) => {
    await until("the runtime has arrived", () => view.server.requestsOf(runtimeFile)[0]?.status === 200);
    await view.page.waitForTimeout(300); // a runtime that does not wait takes over
    assert.equal(await view.page.evaluate(() => window.takenOver), undefined);
    workers.open();
    await until("the preview has drawn the patches", async () => (await view.events("refine", "x3d")).length === 1);
    await view.promise("complete");
    assert.equal((await view.events("refine", "x3d")).length, 1);
  });
});

soakTest("a preview requests patches when the runtime has arrived, and the runtime takes them over", async () => {
  const patches = tagsOf(pageOf(site())).flatMap(({ attributes: { data } }) => (data ? [data.replace(/#.*/, "")] : []));
  const runtime = gate();
  const options = {
    before: watchPreview,
    server: (server: View["server"]): void => void server.when(runtimeFile, { hold: runtime.closed }),
  };
  await withPage(site(), options, async (view) => {
    const requests = (): number =>
      patches.filter((patch) => view.server.requestsOf(new RegExp(patch)).length > 0).length;
    await until("the preview has drawn", async () => (await firstImages(view)) === 1);
    assert.equal(requests(), 0, "the runtime has the line");
    runtime.open();
    await view.promise("complete");
    for (const patch of patches) assert.equal(view.server.requestsOf(new RegExp(patch)).length, 1, patch);
  });
});

soakTest("a base that does not come delays the runtime for a limited time", async () => {
  const base = tagsOf(pageOf(site())).find(({ name }) => name === "imagegeometry")?.attributes.base ?? "";
  const bases = gate();
  const options = {
    before: watchPreview,
    server: (server: View["server"]): void => void server.when(new RegExp(base), { hold: bases.closed }),
  };
  await withPage(site(), options, async (view) => {
    await baseIsWaitedFor(view, base);
    await view.page.evaluate(() => {
      window.endWait?.();
    });
    await view.promise("firstImage");
    assert.ok((await view.events("first-image", "x3d")).every(({ detail }) => detail.stage !== "base"));
    bases.open();
  });
});
