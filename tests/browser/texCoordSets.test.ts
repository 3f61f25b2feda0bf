// Tests several sets of texture coordinates: a baked interior is drawn from every container and compared with three.js'
// GLTFLoader.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { before, describe, test } from "node:test";
import { bundleApp } from "./appBundles.ts";
import { serveApp } from "./appPage.ts";
import { interiorFiles, writeBakedInterior } from "./bakedInterior.ts";
import { assertSamePicture, savePicture, type Bounds } from "./compare.ts";
import { until, withPage } from "./harness.ts";
import { outputDirectory } from "./paths.ts";
import { decodePng, type Picture } from "./png.ts";
import { siteOf, variantOf } from "./sites.ts";
import { soakTest } from "./soak.ts";

const bundles = { "app.js": "tests/browser/texCoordSetsPage.ts", "worker.js": "web/src/workers/worker.ts" };
const directory = join(outputDirectory, "texCoordSets");
const glb = writeBakedInterior();

const containers = {
  compact: ["--container", "sig", "--profile", "compact"],
  classic: ["--container", "sig", "--profile", "classic"],
  bg: ["--container", "bg"],
} as const;

/** With the camera and the light of texCoordSetsPage.ts. */
function siteIn(container: keyof typeof containers, name: string, change = (page: string) => page): string {
  return variantOf(siteOf(glb, ...containers[container]), name, (page) =>
    change(
      page
        .replace(/<DirectionalLight[^>]*><\/DirectionalLight>/g, "")
        .replace(/<Viewpoint[^>]*><\/Viewpoint>/g, "")
        .replace(/<Background[^>]*><\/Background>/g, "")
        .replace(/<NavigationInfo[^>]*><\/NavigationInfo>/g, "")
        .replace(
          /<Scene>/i,
          `<Scene><NavigationInfo headlight="false"></NavigationInfo><Background skyColor="0 0 0"></Background>
          <DirectionalLight intensity="0" ambientIntensity="1"></DirectionalLight>
          <Viewpoint position="0 0 3" fieldOfView="0.785398"></Viewpoint>`,
        ),
    ),
  );
}

/** The picture that the app draws of the GLB or of a site. */
async function pictureOfApp(site: string, url: string): Promise<Picture> {
  let picture: Picture | undefined;
  await withPage(
    site,
    {
      path: "app.html",
      server(server) {
        for (const name of interiorFiles) server.put(`/${name}`, readFileSync(join(outputDirectory, name)));
        serveApp(server, "/app.html", directory, Object.keys(bundles));
      },
    },
    async ({ page }) => {
      await until("the app runs", async () => page.evaluate(() => "drawInterior" in window));
      await page.evaluate((from) => window.drawInterior(from, "/worker.js"), url);
      picture = decodePng(await page.screenshot());
    },
  );
  assert.ok(picture);
  return picture;
}

/** A wall, 0 to 2 from the left, without its sides, where antialiasing differs. */
function wallIn({ width, height, channels, data }: Picture, wall: number): Picture {
  const unit = height / (2 * 3 * Math.tan(Math.PI / 8)); // pixels
  const [left, right] = [0.03, 0.92].map((x) => Math.round(width / 2 + (wall - 1.5 + x) * unit)) as [number, number];
  const [top, bottom] = [-0.47, 0.47].map((y) => Math.round(height / 2 + y * unit)) as [number, number];
  const rows = Array.from({ length: bottom - top }, (_, y) =>
    data.slice(((top + y) * width + left) * channels, ((top + y) * width + right) * channels),
  );
  return {
    width: right - left,
    height: bottom - top,
    channels,
    data: Uint8Array.from(rows.flatMap((row) => [...row])),
  };
}

const bounds: Bounds = { mean: 0.5, offShare: 0.002 };
/**
 * In pages, surfaces also reflect ambient light: 5.7 were measured, and 44 with texture coordinates of the wrong set.
 */
const boundsInAmbientLight: Bounds = { mean: 7, offShare: 0.02 };

describe("a baked interior with two sets of texture coordinates", () => {
  let reference: Picture;
  before(async () => {
    await bundleApp(bundles, directory);
    reference = await pictureOfApp(siteIn("compact", "reference"), "/baked-interior.glb");
    savePicture("interior-three", reference);
  });

  for (const container of Object.keys(containers) as (keyof typeof containers)[])
    (container === "compact" ? test : soakTest)(
      `is drawn from ${container} as three's GLTFLoader draws it`,
      async () => {
        await withPage(siteIn(container, "lit"), {}, async (view) => {
          await view.promise("complete");
          const picture = await view.picture();
          savePicture(`interior-${container}`, picture);
          for (const [wall, allowed] of [bounds, boundsInAmbientLight, boundsInAmbientLight].entries())
            assertSamePicture(`interior-${container}-${wall}`, wallIn(picture, wall), wallIn(reference, wall), allowed);
        });
      },
    );

  soakTest("is drawn by ImgeoLoader as by GLTFLoader", async () => {
    for (const container of ["compact", "classic"] as const) {
      const picture = await pictureOfApp(siteIn(container, "app"), "/scene.x3d");
      for (const wall of [0, 1, 2])
        assertSamePicture(`interior-app-${container}-${wall}`, wallIn(picture, wall), wallIn(reference, wall), bounds);
    }
  });
});
