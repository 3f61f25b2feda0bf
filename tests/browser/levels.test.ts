// Meshes with levels of detail: pictures, holes, memory and requests, and files that fail.

import assert from "node:assert/strict";
import { test } from "node:test";
import { assertSamePicture, savePicture } from "./compare.ts";
import { finalPicture, screenshotOf, settle, until, withPage, type View } from "./harness.ts";
import type { ShapePointerEvent } from "../../web/src/dom/index.ts";
import { groupFilesOf, magentaInside, onMagenta, seenFrom, statisticsOf } from "./levelPages.ts";
import { siteOfRelief, variantOf } from "./sites.ts";
import { isSoak, soakTest } from "./soak.ts";

const plainSite = (): string => siteOfRelief(60_000);
const levelsSite = (): string => siteOfRelief(60_000, "--levels", "always", "--group-triangles", "1024");

async function moveTo({ page }: View, position: string, orientation: string): Promise<void> {
  await page.evaluate(
    ([p, o]) => {
      const viewpoint = document.querySelector("viewpoint");
      viewpoint?.setAttribute("position", p);
      viewpoint?.setAttribute("orientation", o);
    },
    [position, orientation] as const,
  );
}

const comparedViews = [
  ["far", "0 0 3", "0 0 1 0", 400_000],
  ["near", "0.5 0 1.4", "0 1 0 0.2", 800_000],
  ["limb", "1.2 0 0.9", "0 1 0 0.35", 800_000],
] as const;

test("a mesh with levels has the picture of the mesh without, near, far and at its limb", async () => {
  for (const [name, position, orientation, maxBytes] of isSoak ? comparedViews : comparedViews.slice(0, 1)) {
    const seen = (page: string) => seenFrom(page, position, orientation);
    const expected = await finalPicture(variantOf(plainSite(), name, seen));
    await withPage(variantOf(levelsSite(), name, seen), {}, async (view) => {
      await view.promise("complete");
      assertSamePicture(`levels ${name}`, await view.picture(), expected, { mean: 1.5, offShare: 0.01 });
      const requested = groupFilesOf(view);
      assert.deepEqual(requested, [...new Set(requested)], "a file was requested twice");
      const { bufferBytes } = await statisticsOf(view); // all of level 0 takes some 750,000
      assert.ok(bufferBytes < maxBytes, `${name}: ${bufferBytes} bytes`);
      const stages = (await view.events("refine", "x3d")).map(({ detail }) => detail.stage);
      assert.deepEqual(stages.at(-1), "full");
    });
  }
});

soakTest("no pixel of the backdrop is seen inside of the silhouette during a slow load and a flight", async () => {
  const site = variantOf(levelsSite(), "magenta", onMagenta);
  const server = (server: View["server"]): void => {
    server.useLink({ bitsPerSecond: 3e6, roundTripMs: 40 });
  };
  await withPage(site, { server }, async (view) => {
    await view.promise("firstImage");
    const views = [
      ["0 0 3", "0 0 1 0"],
      ["0.5 0 1.6", "0 1 0 0.2"],
      ["1.2 0 1", "0 1 0 0.35"],
      ["0 0.6 2.2", "1 0 0 -0.2"],
    ] as const;
    let checked = 0;
    for (const [position, orientation] of isSoak ? [...views, ...views] : views) {
      await moveTo(view, position, orientation);
      for (let shot = 0; shot < 3; ++shot, ++checked) {
        const picture = await screenshotOf(view.page);
        const holes = magentaInside(picture);
        if (holes > 0) savePicture(`levels hole ${checked}`, picture);
        assert.equal(holes, 0, `picture ${checked}`);
      }
    }
    assert.ok(groupFilesOf(view).length > 30, "the flight needed few groups");
  });
});

test("a group that is missing is one error, and the picture stays closed", async () => {
  const site = variantOf(levelsSite(), "missing", (page) => onMagenta(seenFrom(page, "0 0 2.2", "0 0 1 0")));
  const server = (server: View["server"]): void => {
    server.when((path) => path.endsWith("/0/2.png"), { status: 404 });
  };
  await withPage(site, { server, expectedErrors: /404|2\.png/ }, async (view) => {
    await until("an error", async () => (await view.events("error", "x3d")).length > 0);
    await until("all groups", async () => (await statisticsOf(view)).openRequests === 0);
    const picture = await view.picture();
    savePicture("levels missing", picture);
    assert.equal(magentaInside(picture), 0);
    const errors = await view.events("error", "x3d");
    assert.deepEqual(
      errors.map(({ detail }) => detail.type),
      ["http"],
    );
    // Once by the preview and once by the runtime, which reports the error.
    assert.equal(groupFilesOf(view).filter((path) => path.endsWith("/0/2.png")).length, 2);
  });
});

test("a mesh whose index is missing is one error and left out", async () => {
  const site = variantOf(levelsSite(), "without-index", (page) => onMagenta(page));
  const server = (server: View["server"]): void => {
    server.when((path) => path.endsWith("/levels.png"), { status: 404 });
  };
  await withPage(site, { server, expectedErrors: /404|levels\.png/ }, async (view) => {
    await view.promise("complete");
    await settle(view.page);
    assert.deepEqual(
      (await view.events("error", "x3d")).map(({ detail }) => detail.type),
      ["http"],
    );
    assert.equal((await statisticsOf(view)).openRequests, 0);
    assert.ok(groupFilesOf(view).length <= 1, "groups are requested that cannot be displayed");
  });
});

test("the GPU memory stays within a small budget, nothing is fetched twice, and a page at rest is idle", async () => {
  const budget = 0.4;
  const site = variantOf(levelsSite(), "budget", (page) =>
    seenFrom(page, "0.5 0 1.4", "0 1 0 0.2").replace(/<X3D /i, `<X3D budget="${budget}" `),
  );
  await withPage(site, {}, async (view) => {
    await view.promise("complete");
    await settle(view.page);
    const { bufferBytes, frames, levels } = await statisticsOf(view);
    assert.equal(levels.bytes, bufferBytes);
    assert.ok(levels.errorInPixels > 1, "more would be drawn of a larger budget");
    assert.ok(bufferBytes <= budget * 1e6 && bufferBytes > 0.5 * budget * 1e6, `${bufferBytes} bytes`);
    const requested = groupFilesOf(view);
    assert.deepEqual(requested, [...new Set(requested)]);
    await view.page.waitForTimeout(1500);
    const later = await statisticsOf(view);
    assert.deepEqual([groupFilesOf(view).length, later.frames], [requested.length, frames]);
  });
});

interface LevelHit {
  readonly point: readonly [number, number, number];
  readonly patch: number;
  readonly triangleId: number | null;
  readonly accuracy: number | null;
}

/** Clicks at points of a row through the middle of the view. */
async function hitsAlongRow({ page }: View): Promise<LevelHit[]> {
  await page.evaluate(() => {
    const hits: unknown[] = ((globalThis as unknown as { hits: unknown[] }).hits = []);
    document.querySelector("x3d")!.addEventListener("click", (event) => {
      const { worldPosition: p, patch, triangleId, accuracy } = event as unknown as ShapePointerEvent;
      hits.push({ point: [p.x, p.y, p.z], patch, triangleId, accuracy });
    });
  });
  const hits = () => page.evaluate(() => (globalThis as unknown as { hits: LevelHit[] }).hits);
  const box = await page.evaluate(() => document.querySelector("x3d")!.getBoundingClientRect().toJSON() as DOMRect);
  for (const [n, share] of [0.4, 0.45, 0.5, 0.55, 0.6].entries()) {
    await page.mouse.click(box.x + share * box.width, box.y + box.height / 2);
    await until("the click", async () => (await hits()).length > n);
  }
  return hits();
}

soakTest("a hit tells how far the mesh may be, and has the mesh's triangles where it is drawn whole", async () => {
  const near = (page: string): string => seenFrom(page, "0.5 0 1.4", "0 1 0 0.2");
  const hitsOf = async (site: string): Promise<LevelHit[]> => {
    let hits: LevelHit[] = [];
    await withPage(site, {}, async (view) => {
      await view.promise("complete");
      hits = await hitsAlongRow(view);
    });
    return hits;
  };
  const whole = await hitsOf(variantOf(plainSite(), "hit", near));
  const refined = await hitsOf(variantOf(levelsSite(), "hit", near));
  const budget = (page: string): string => near(page).replace(/<X3D /i, '<X3D budget="0.2" ');
  const coarse = await hitsOf(variantOf(levelsSite(), "hit-budget", budget));
  assert.ok(whole.every(({ accuracy, triangleId }) => accuracy === 0 && triangleId !== null));
  assert.ok(coarse.some(({ accuracy }) => accuracy !== null && accuracy > 1e-4));
  for (const [n, hit] of [...refined, ...coarse].entries()) {
    const { point, accuracy, triangleId, patch } = hit;
    assert.ok(accuracy !== null && accuracy < 0.1 && patch >= 0, JSON.stringify(hit));
    assert.equal(triangleId === null, accuracy > 0, JSON.stringify(hit));
    const distance = Math.hypot(...point.map((value, axis) => value - whole[n % whole.length]!.point[axis]!));
    assert.ok(distance <= 3 * accuracy + 1e-4, `${distance}: ${JSON.stringify(hit)}`); // along rays that are not normal
  }
});

test("refineAt loads the mesh itself around a point, which is then hit exactly", async () => {
  const far = variantOf(levelsSite(), "refine-at", (page) => seenFrom(page, "0 0 6", "0 1 0 0"));
  await withPage(far, {}, async (view) => {
    await view.promise("complete");
    const [, , coarse] = await hitsAlongRow(view);
    assert.ok(coarse?.accuracy && coarse.triangleId === null, JSON.stringify(coarse));
    await view.page.evaluate(([x, y, z]) => {
      const x3d = document.querySelector("x3d") as unknown as { refineAt(point: object): void };
      x3d.refineAt({ x, y, z });
    }, coarse.point);
    await until("all groups", async () => (await statisticsOf(view)).openRequests === 0);
    await settle(view.page);
    const [, , exact] = await hitsAlongRow(view);
    assert.ok(exact?.accuracy === 0 && exact.triangleId !== null, JSON.stringify(exact));
    const distance = Math.hypot(...exact.point.map((value, axis) => value - coarse.point[axis]!));
    assert.ok(distance <= 3 * coarse.accuracy, `${distance} of ${coarse.accuracy}`);
  });
});

soakTest("a lost context is drawn again", async () => {
  await withPage(levelsSite(), {}, async (view) => {
    await view.promise("complete");
    // Makes the runtime draw in the preview's stead, whose picture differs by rounding, and whose context is another.
    await view.page.evaluate(() => (document.querySelector("x3d") as unknown as { toBlob(): Promise<Blob> }).toBlob());
    const { frames } = await statisticsOf(view);
    assert.ok(frames > 0);
    const before = await view.picture();
    await view.page.evaluate(async () => {
      const canvas = Array.from(document.querySelectorAll("*")).flatMap((element) =>
        Array.from(element.shadowRoot?.querySelectorAll("canvas") ?? (element.localName === "canvas" ? [element] : [])),
      )[0] as HTMLCanvasElement;
      const extension = canvas.getContext("webgl2")?.getExtension("WEBGL_lose_context");
      extension?.loseContext();
      await new Promise((resolve) => setTimeout(resolve, 200));
      extension?.restoreContext();
    });
    await view.page.waitForTimeout(500);
    await until("all groups", async () => (await statisticsOf(view)).openRequests === 0);
    assert.ok((await statisticsOf(view)).frames > frames, "the runtime draws again");
    assertSamePicture("levels restored", await view.picture(), before, { mean: 0 });
  });
});
