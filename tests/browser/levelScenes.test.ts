// Scenes with several meshes with levels of detail, one of them with two instances, beside an ordinary shape.

import assert from "node:assert/strict";
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { assertSamePicture } from "./compare.ts";
import { finalPicture, settle, withPage } from "./harness.ts";
import { groupFilesOf, statisticsOf } from "./levelPages.ts";
import { sphere, trefoil, type PlainMesh } from "./meshes.ts";
import { outputDirectory } from "./paths.ts";
import { siteOf, variantOf } from "./sites.ts";
import { soakTest } from "./soak.ts";

function shape(name: string, color: string, { positions, triangles }: PlainMesh): string {
  return `<Shape DEF="${name}"><Appearance><Material diffuseColor="${color}"/></Appearance>
    <IndexedTriangleSet index="${triangles.join(" ")}"><Coordinate point="${positions.join(" ")}"/></IndexedTriangleSet>
  </Shape>`;
}

/** A ball before a box, and two knots, the second of which is far behind and turned. */
function scene(): string {
  const file = join(outputDirectory, "level-scene.x3d");
  mkdirSync(outputDirectory, { recursive: true });
  writeFileSync(
    file,
    `<X3D profile="Interchange" version="4.0"><Scene>
      <Viewpoint position="0 0 9" fieldOfView="0.8"/>
      <Transform translation="-1.8 0 4">${shape("ball", "1 0.4 0.2", sphere(64))}</Transform>
      <Transform translation="2.4 0 -1">${shape("knot", "0.2 0.5 1", trefoil(500, 32))}</Transform>
      <Transform translation="-14 6 -40" rotation="0 1 0 1"><Shape USE="knot"/></Transform>
      <Transform translation="-1.8 -1.8 4"><Shape><Appearance><Material diffuseColor="0.2 0.7 0.3"/></Appearance>
        <Box size="2 1 2"/></Shape></Transform>
    </Scene></X3D>`,
  );
  return file;
}

let source: string | undefined;
const plainSite = (): string => siteOf((source ??= scene()), "--no-pictures");
const levelsSite = (): string =>
  siteOf((source ??= scene()), "--no-pictures", "--levels", "always", "--group-triangles", "1024");

const folderOf = (path: string): string => path.split("/")[1] ?? "";

soakTest(
  "meshes with levels, their instances and ordinary shapes have the picture of the scene without levels",
  async () => {
    const expected = await finalPicture(variantOf(plainSite(), "scene", (page) => page));
    await withPage(
      variantOf(levelsSite(), "scene", (page) => page),
      {},
      async (view) => {
        await view.promise("complete");
        assertSamePicture("levels in a scene", await view.picture(), expected, { mean: 1, offShare: 0.01 });
        assert.equal(new Set(groupFilesOf(view).map(folderOf)).size, 2, "an instance has files of its own");
        assert.ok((await statisticsOf(view)).levels.errorInPixels <= 1);
      },
    );
  },
);

soakTest("a near mesh takes the memory that far ones do not need, and a scene at rest is idle", async () => {
  const budget = 0.26;
  const site = variantOf(levelsSite(), "scene-budget", (page) =>
    page
      .replace(/<X3D /i, `<X3D budget="${budget}" `)
      .replace(/(<Viewpoint[^>]*?position=")[^"]*"/i, '$1-1.8 0 2.7" orientation="0 1 0 3.1416"'),
  );
  await withPage(site, {}, async (view) => {
    await view.promise("complete");
    await settle(view.page);
    // The ball fills the view; the knots are behind the camera. With equal parts nearly half of the memory would be empty.
    const { levels, frames } = await statisticsOf(view);
    assert.ok(levels.bytes <= budget * 1e6 && levels.bytes > 0.8 * budget * 1e6, `${levels.bytes} bytes`);
    const requested = groupFilesOf(view);
    assert.deepEqual(requested, [...new Set(requested)], "a file was requested twice");
    await view.page.waitForTimeout(1500);
    assert.deepEqual([groupFilesOf(view).length, (await statisticsOf(view)).frames], [requested.length, frames]);
  });
});
