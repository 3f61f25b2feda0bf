// Tests skins and morph targets: moments of an animation, drawn from every container, are compared with those of three.js'
// GLTFLoader, in the same app with the same lights and shadows.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { basename, join } from "node:path";
import { before, describe, test } from "node:test";
import { bundleApp } from "./appBundles.ts";
import { serveApp } from "./appPage.ts";
import { savePicture } from "./compare.ts";
import { until, withPage } from "./harness.ts";
import { outputDirectory } from "./paths.ts";
import { decodePng, type Picture } from "./png.ts";
import { writeRiggedScene } from "./riggedScene.ts";
import { siteOf } from "./sites.ts";
import { soakTest } from "./soak.ts";

const bundles = { "app.js": "tests/browser/riggedPage.ts", "worker.js": "web/src/workers/worker.ts" };
const directory = join(outputDirectory, "skins");
const moments = [0, 0.3, 0.8, 1.4, 1.9];
/** Levels of 255. */
const maxMeanDifference = 0.05;

const containers = {
  compact: ["--container", "sig", "--profile", "compact", "--normal-bits", "16", "--position-bits", "18"],
  classic: ["--container", "sig", "--profile", "classic", "--normals", "octahedral", "--normal-bits", "16"],
  bg: ["--container", "bg", "--normal-bits", "16"],
} as const;

before(() => bundleApp(bundles, directory));

/** The pictures that the app draws of a file: of the GLB, or of the document of its site. */
async function picturesOfApp(site: string, glb: string, url: string): Promise<Picture[]> {
  const pictures: Picture[] = [];
  await withPage(
    site,
    {
      path: "app.html",
      server(server) {
        server.put(`/${basename(glb)}`, readFileSync(glb));
        serveApp(server, "/app.html", directory, Object.keys(bundles));
      },
    },
    async ({ page }) => {
      await until("the app runs", async () => page.evaluate(() => "loadModel" in window));
      await page.evaluate((from) => window.loadModel(from, "/worker.js", 5.5), url);
      for (const moment of moments) {
        await page.evaluate((seconds) => window.drawMoment(seconds), moment);
        pictures.push(decodePng(await page.screenshot()));
      }
    },
  );
  return pictures;
}

function meanDifference(a: Picture, b: Picture): number {
  assert.deepEqual([a.width, a.height, a.channels], [b.width, b.height, b.channels]);
  return a.data.reduce((sum, value, i) => sum + Math.abs(value - (b.data[i] ?? 0)), 0) / a.data.length;
}

for (const shading of ["smooth", "flat"] as const)
  describe(`an animated scene with skins and morph targets, ${shading === "flat" ? "without" : "with"} normals`, () => {
    const glb = writeRiggedScene(shading);
    let reference: Picture[];
    before(async () => {
      reference = await picturesOfApp(siteOf(glb, ...containers.compact), glb, `/${basename(glb)}`);
      reference.forEach((picture, i) => {
        savePicture(`rigged-${shading}-three-${i}`, picture);
      });
      for (const picture of reference.slice(1)) assert.ok(meanDifference(picture, reference[0]!) > 0.3, "it moves");
    });

    for (const container of Object.keys(containers) as (keyof typeof containers)[])
      (container === "compact" && shading === "smooth" ? test : soakTest)(
        `is drawn from ${container} by ImgeoLoader as by GLTFLoader at each moment`,
        async () => {
          const pictures = await picturesOfApp(siteOf(glb, ...containers[container]), glb, "/scene.x3d");
          const differences = pictures.map((picture, i) => meanDifference(picture, reference[i]!));
          pictures.forEach((picture, i) => {
            savePicture(`rigged-${shading}-${container}-${i}`, picture);
          });
          const means = differences.map((mean) => mean.toFixed(4)).join(", ");
          console.log(`${shading} ${container}: mean differences ${means} of 255`);
          for (const [i, difference] of differences.entries())
            assert.ok(difference <= maxMeanDifference, `moment ${moments[i]}: ${difference} of 255`);
        },
      );
  });
