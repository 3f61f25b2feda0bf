// Meshes with levels of detail in a three.js app: `update` refines them by the app's camera, within the budget.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdirSync } from "node:fs";
import { join } from "node:path";
import { before, test } from "node:test";
import { bundleApp } from "./appBundles.ts";
import { serveApp } from "./appPage.ts";
import { assertSamePicture, difference, holesIn, savePicture, silhouette } from "./compare.ts";
import { largePictureSize, until, withPage, type View } from "./harness.ts";
import type { DrawRequest } from "./levelsLoaderPage.ts";
import { converter, outputDirectory } from "./paths.ts";
import { decodePng, type Picture } from "./png.ts";
import { siteOf } from "./sites.ts";
import { soakTest } from "./soak.ts";

const bundles = { "app.js": "tests/browser/levelsLoaderPage.ts", "worker.js": "web/src/workers/worker.ts" };
const directory = join(outputDirectory, "levels-loader");
const groupPattern = /\/\d+\/\d+\.png$/;
let plain: string;
let levels: string;

before(async () => {
  await bundleApp(bundles, directory);
  const file = join(outputDirectory, "relief-of-loader.ply");
  mkdirSync(outputDirectory, { recursive: true });
  execFileSync(converter, ["sample", "relief", "--triangles", "60000", "-o", file], { stdio: "ignore" });
  plain = siteOf(file, "--no-pictures");
  levels = siteOf(file, "--no-pictures", "--levels", "always", "--group-triangles", "1024");
});

async function withApp(site: string, use: (view: View) => Promise<void>): Promise<void> {
  const server = (server: View["server"]): void => {
    serveApp(server, "/", directory, Object.keys(bundles));
  };
  // Large enough for a cut of several groups.
  await withPage(site, { server, size: largePictureSize }, async (view) => {
    await until("the app runs", async () => view.page.evaluate(() => "levels" in window));
    await use(view);
  });
}

const far = { from: [0, 0, 4], to: [0, 0, 0] } as const;
const near = { from: [0.9, 0.3, 1.9], to: [0.5, 0, 0] } as const;

const load = ({ page }: View, budget = 1e9): Promise<number> =>
  page.evaluate((bytes) => window.levels.load("scene.x3d", bytes), budget);
const groupsOf = ({ requestedPaths }: View): string[] => requestedPaths.filter((path) => groupPattern.test(path));
const bytesOf = ({ page }: View, scene: number): Promise<number> =>
  page.evaluate((number) => window.levels.bytes(number), scene);

async function converged({ page }: View, request: DrawRequest): Promise<Picture> {
  await page.evaluate((drawn) => window.levels.converge(drawn), request);
  return decodePng(await page.screenshot());
}

test("a scene that follows a camera has the picture of the mesh without levels, and only its roots before", async () => {
  let expected: Picture | undefined;
  await withApp(plain, async (view) => {
    expected = await converged(view, { ...near, scene: await load(view) });
  });
  await withApp(levels, async (view) => {
    const scene = await load(view);
    assert.deepEqual(groupsOf(view).length, 1, "groups are requested before a camera is known");
    await view.page.evaluate(
      (request) => {
        window.levels.draw(request);
      },
      { ...near, scene },
    );
    const coarse = decodePng(await view.page.screenshot());
    const fine = await converged(view, { ...near, scene });
    assert.ok(expected !== undefined);
    assertSamePicture("levels of the loader", fine, expected, { mean: 0.5, offShare: 0.002 });
    assert.ok(difference(coarse, expected).mean > 10 * difference(fine, expected).mean, "the roots look the same");
    const requested = groupsOf(view);
    assert.ok(requested.length > 10, `${requested.length} groups`);
    assert.deepEqual(requested, [...new Set(requested)], "a file was requested twice");
    assert.ok((await bytesOf(view, scene)) < 500_000);
  });
});

soakTest("each scene follows the cameras that it is told, within its budget, until it is disposed of", async () => {
  await withApp(levels, async (view) => {
    const [small, other] = [await load(view, 300_000), await load(view)];
    await converged(view, { ...near, scene: small });
    const bytes = await bytesOf(view, small);
    assert.ok(bytes <= 300_000 && bytes > 150_000, `${bytes} bytes`);
    const rootBytes = await bytesOf(view, other);
    await converged(view, { ...far, scene: other });
    const farBytes = await bytesOf(view, other);
    assert.ok(farBytes > rootBytes, `${farBytes} bytes, as the roots`);
    const requested = groupsOf(view).length;
    await view.page.evaluate((scene) => {
      window.levels.dispose(scene);
    }, other);
    await converged(view, { ...near, scene: other });
    assert.equal(groupsOf(view).length, requested, "a scene that has been disposed of requests groups");
  });
});

soakTest("a cloud with levels has no gaps in the app's picture, within any budget", async () => {
  const file = join(outputDirectory, "cloud-of-loader.ply");
  execFileSync(converter, ["sample", "relief", "--points", "60000", "-o", file], { stdio: "ignore" });
  const site = siteOf(file, "--no-pictures", "--levels", "always", "--group-triangles", "1024");
  await withApp(site, async (view) => {
    let groups = 0;
    for (const budget of [1e5, 1e9]) {
      const scene = await load(view, budget);
      const picture = await converged(view, { ...far, scene });
      savePicture(`levels of the loader, points, ${budget}`, picture);
      const covered = silhouette(picture, { ...picture, data: blackLike(picture) });
      assert.ok(covered.reduce((sum, isCovered) => sum + isCovered, 0) > 10_000, "the cloud is drawn");
      assert.equal(holesIn(covered, picture.width), 0);
      assert.ok((await bytesOf(view, scene)) <= budget);
      assert.ok(groupsOf(view).length > groups, "a larger budget needs more groups");
      groups = groupsOf(view).length;
      await view.page.evaluate((number) => {
        window.levels.dispose(number);
      }, scene);
    }
  });
});

/** Opaque black of the size of a picture: the app's background. */
function blackLike({ data, channels }: Picture): Picture["data"] {
  return data.map((_, i) => (channels === 4 && i % 4 === 3 ? 255 : 0));
}
