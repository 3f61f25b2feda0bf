// Tests surfaces over the grid of an image: terrain, geometry image, sculpted prim.

import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { assertSamePicture, boundsOfQuantised, savePicture } from "./compare.ts";
import { meshOf, shapeOf, shapeOfParts, sheet, terrain, vase, type GridExample } from "./generators/grids.ts";
import { center } from "./gestures.ts";
import { pictureSize, withPage, type View } from "./harness.ts";
import { decodePng } from "./png.ts";
import { firstHit, rayThrough } from "./rays.ts";
import { minus, type Vec3 } from "./vectors.ts";
import { referenceSettingsOf, referencePicture } from "./reference.ts";
import { pageOf, siteOfGenerated } from "./sites.ts";
import { soakTest } from "./soak.ts";

const site = (): string => siteOfGenerated("trefoil", "--profile", "classic");

/** A page that displays the example, or a Shape of its parts, from the front and above. */
function pageWith(example: GridExample, attributes = "", shape = shapeOf(example, attributes)): string {
  return pageOf(site())
    .replace(/<link rel="preload"[^>]*>/g, "")
    .replace(/<Shape[\s\S]*<\/Shape>/i, () => shape)
    .replace(/<Viewpoint[^>]*>/i, `<Viewpoint position="0.6 2.6 5.2" orientation="-1 0.1 0 0.45" fieldOfView="0.75">`);
}

function serving({ files }: Pick<GridExample, "files">, html: string): (server: View["server"]) => void {
  return (server) => {
    for (const [path, body] of files) server.put(path, body);
    server.when(/^\/$/, { replace: () => html });
  };
}

const plain = (example: GridExample) =>
  meshOf(
    example,
    [...example.files.values()].map((file) => decodePng(file)),
  );

for (const [name, example] of [
  ["terrain", terrain()],
  ["sheet", sheet()],
  ["vase", vase()],
] as const) {
  describe(`the ${name}`, () => {
    for (const decode of ["gpu", "cpu"]) {
      const sample = decode === (name === "sheet" ? "cpu" : "gpu") && name !== "vase" ? test : soakTest;
      sample(`is the surface of its texels, shaded by its computed normals, on the ${decode}`, async () => {
        const html = pageWith(example, `decode="${decode}"`);
        await withPage(site(), { server: serving(example, html) }, async (view) => {
          await view.promise("complete");
          const picture = await view.picture();
          savePicture(`grid ${name} ${decode}`, picture);
          assertSamePicture(
            `grid ${name} on the ${decode}`,
            picture,
            await referencePicture(html, [plain(example)]),
            boundsOfQuantised,
          );
        });
      });
    }

    // A height map is in six images here: its picture, too, is that of the whole, without a seam.
    (name === "vase" ? test : soakTest)("is hit by the pointer", async () => {
      const parts = name === "terrain" ? shapeOfParts(example, { columns: [31, 50], rows: [22] }) : undefined;
      const html = pageWith(example, "", parts?.shape);
      const mesh = plain(example);
      await withPage(site(), { server: serving(parts ?? example, html) }, async (view) => {
        await view.promise("complete");
        const picture = await view.picture();
        if (parts !== undefined) {
          savePicture("grid terrain in six images", picture);
          const reference = await referencePicture(html, [parts.mesh]);
          assertSamePicture("grid terrain in six images", picture, reference, boundsOfQuantised);
        }
        let hits = 0;
        for (const [dx, dy] of [
          [0, 0],
          [-15, -30],
          [20, 30],
          [-30, 45],
          [10, 60],
        ] as const) {
          const [x, y] = [center.x + dx, center.y + dy];
          const expected = firstHit(rayThrough(referenceSettingsOf(html).viewpoint, pictureSize, x, y), [mesh]);
          const found = await view.page.evaluate(
            ([x, y]) => {
              const point = document
                .querySelector<
                  HTMLElement & {
                    positionAndNormalFromPoint(
                      x: number,
                      y: number,
                    ): { position: { x: number; y: number; z: number } } | null;
                  }
                >("imgeo-view")!
                .positionAndNormalFromPoint(x, y);
              return point && `${point.position.x} ${point.position.y} ${point.position.z}`;
            },
            [x + 0.5, y + 0.5] as const,
          );
          assert.equal(found !== null, expected !== undefined, `at ${x}, ${y}`);
          if (found === null || expected === undefined) continue;
          ++hits;
          assert.ok(Math.hypot(...minus(found.split(" ").map(Number) as Vec3, expected.position)) < 1e-5);
        }
        assert.ok(hits >= 3, `${hits} hits`);
      });
    });
  });
}
