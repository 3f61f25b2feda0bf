// Compares pages in the layouts of X3DOM's own tools: drawn by the releases of X3DOM that read them, by imgeo's runtime
// as they are, and by imgeo's runtime after `imgeo convert old/index.html -o new`.

import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { difference, savePicture } from "../browser/compare.ts";
import { withPage } from "../browser/harness.ts";
import type { Picture } from "../browser/png.ts";
import { pageOf, siteOf } from "../browser/sites.ts";
import { soakTest } from "../browser/soak.ts";
import { layouts, type Layout } from "./foreignLayouts.ts";
import { cellOf, emptyCell, foreignSize, sceneOf, writeForeignSite } from "./foreignPage.ts";
import { pictureOf, type Container } from "./releases.ts";

/**
 * Bounds of the mean difference of a colour channel, 0 … 255, in the part of the picture that shows one layout: as the
 * page is, and converted to compact, with normals of 8 bits. Edges that a clip plane makes are antialiased differently.
 */
const bounds = { asItIs: 0.03, converted: 0.25, clipped: 0.8 };

const releases: readonly Container[] = ["sig", "bg"];
const versions: Readonly<Record<Container, string>> = { sig: "1.7.2", bg: "1.8.3" };

/** X3DOM's page: by default X3DOM adds linear light, which X3D 4 requires only of PhysicalMaterial. */
function pageOfX3dom(scene: string): string {
  const head = '<script src="x3dom/x3dom.js"></script><link rel="stylesheet" href="x3dom/x3dom.css">';
  const style = "<style>body { margin: 0 } x3d { border: 0 }</style>";
  const environment = '<Environment gammaCorrectionDefault="none"></Environment>';
  return `<!doctype html><html><head>${head}${style}</head><body>${scene.replace("<Scene>", `<Scene>${environment}`)}</body></html>`;
}

async function ourPictureOf(site: string, html: string, folder: string, expectedErrors?: RegExp): Promise<Picture> {
  let picture: Picture | undefined;
  await withPage(
    site,
    {
      path: "old.html",
      size: foreignSize,
      ...(expectedErrors ? { expectedErrors } : {}),
      server(server) {
        for (const name of readdirSync(folder)) server.put(`/${name}`, readFileSync(join(folder, name)));
        server.put("/old.html", html);
      },
    },
    async (view) => {
      await view.promise("complete");
      picture = await view.picture();
    },
  );
  return picture ?? assert.fail("no picture");
}

soakTest("sites of X3DOM's own tools are drawn as X3DOM draws them, as they are and converted", async (context) => {
  const folder = writeForeignSite();
  const site = siteOf(join(folder, "index.html"));
  const runtimePage = pageOf(site)
    .replace(/<link rel="preload"[^>]*>/g, "")
    .replace(/<X3D[\s\S]*<\/X3D>/i, () => sceneOf(() => true));
  const drawn = await ourPictureOf(site, runtimePage, folder, /PopGeometry/i);
  const converted = await ourPictureOf(site, pageOf(site), folder);
  savePicture("foreign-as-it-is", drawn);
  savePicture("foreign-converted", converted);
  const faults: string[] = [];
  for (const release of releases) {
    const isShown = (layout: Layout): boolean => layout.releases.includes(release);
    const expected = await pictureOf(folder, release, pageOfX3dom(sceneOf(isShown)), {}, foreignSize);
    savePicture(`foreign-x3dom-${release}`, expected);
    layouts.forEach((layout, index) => {
      if (!isShown(layout)) return;
      assert.ok(difference(cellOf(expected, index), emptyCell(expected)).mean > 2, `X3DOM draws no ${layout.name}`);
      const differenceTo = (picture: Picture): number =>
        difference(cellOf(picture, index), cellOf(expected, index)).mean;
      const asItIs = layout.isRefused ? 0 : differenceTo(drawn);
      const afterConvert = differenceTo(converted);
      const line = `${versions[release]}, ${layout.name}: ${layout.isRefused ? "–" : asItIs.toFixed(2)}, converted ${afterConvert.toFixed(2)}`;
      context.diagnostic(line);
      const isClipped = layout.markup.includes("<ClipPlane");
      if (
        asItIs > (isClipped ? bounds.clipped : bounds.asItIs) ||
        afterConvert > (isClipped ? bounds.clipped : bounds.converted)
      )
        faults.push(line);
    });
  }
  assert.deepEqual(faults, []);
});
