// Tests the terrain example: a real elevation model, converted from GeoTIFF and served to a phone.

import assert from "node:assert/strict";
import { cpSync, mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import type { ViewElement } from "../../web/src/dom/imgeoView.ts";
import { geoTiffOf, readElevationModel } from "../../examples/terrain/dem.ts";
import { terrainPage } from "../../examples/terrain/page.ts";
import { savePicture } from "./compare.ts";
import { until, withPage } from "./harness.ts";
import { outputDirectory, repository } from "./paths.ts";
import { pageOf, siteOf, variantOf } from "./sites.ts";
import { soakTest } from "./soak.ts";

soakTest(
  "an elevation model is a surface in metres, coloured by height, whose heights a finger exaggerates",
  async () => {
    const model = readElevationModel();
    mkdirSync(outputDirectory, { recursive: true });
    const file = join(outputDirectory, "jacksboro.tif");
    writeFileSync(file, geoTiffOf(model));
    const options = ["--keep-attributes", "height", "--attribute-bits", "8", "--exaggerate", "2"];
    const converted = siteOf(file, ...options);
    const site = variantOf(converted, "terrain", (page) => {
      assert.match(page, /<MetadataSet containerField="metadata" name="georeference">/i);
      assert.match(page, /name="crs" value='"EPSG:4326"'/);
      return terrainPage(page, "Jacksboro fault", "A valley.", [240, 1070]);
    });
    for (const name of ["terrain.css", "terrain.js"])
      cpSync(join(repository, "examples/terrain", name), join(site, name));
    const [width, relief, depth] = /<Shape[^>]* bboxSize="([^"]*)"/i.exec(pageOf(site))![1]!.split(" ").map(Number);
    // 402/1200 degrees of longitude at a latitude of 36.59 degrees, 343/1200 degrees of latitude; 840 m of relief.
    assert.ok(Math.abs(width! - 29_973) < 30 && Math.abs(depth! - 31_718) < 30, `${width} x ${depth}`);
    assert.ok(Math.abs(relief! - 840) < 1, `${relief}`);

    await withPage(site, { size: { width: 390, height: 844 }, hasTouch: true }, async (view) => {
      await view.promise("complete");
      const { page } = view;
      /** Checks that the points of the picture have the model's heights times `exaggeration`. */
      const checkHeights = async (exaggeration: number): Promise<boolean> => {
        for (const y of [380, 420, 460]) {
          const point = await page.evaluate((y) => {
            const found = document.querySelector<ViewElement>("x3d")!.positionAndNormalFromPoint(195, y);
            return found && [found.position.x, found.position.y, found.position.z];
          }, y);
          if (point === null) return false;
          const column = Math.round((point[0]! / width! + 0.5) * (model.columns - 1));
          const row = Math.round((point[2]! / depth! + 0.5) * (model.rows - 1));
          const around = [-1, 0, 1].flatMap((dy) =>
            [-1, 0, 1].map((dx) => model.heights[(row + dy) * model.columns + column + dx]!),
          );
          const height = point[1]! / exaggeration;
          if (height < Math.min(...around) - 1 || height > Math.max(...around) + 1) return false;
        }
        return true;
      };
      savePicture("terrain on a phone", await view.picture());
      assert.ok(await checkHeights(2));

      const slider = (await page.getByRole("slider").boundingBox())!;
      await page.touchscreen.tap(slider.x + slider.width - 3, slider.y + slider.height / 2);
      await until("the heights are exaggerated six times", () => checkHeights(6));
      savePicture("terrain exaggerated", await view.picture());
    });
  },
);
