// Tests that wheel and fingers bring the camera before a surface, not through it.

import assert from "node:assert/strict";
import { describe } from "node:test";
import { center, touch } from "./gestures.ts";
import { settle, withPage, type View } from "./harness.ts";
import { siteOfGenerated } from "./sites.ts";
import { soakTest } from "./soak.ts";
import type { ViewElement } from "../../web/src/dom/imgeoView.ts";

/** Distance of the camera from the center of the scene, a sphere of radius 1. */
async function distance({ page }: View): Promise<number> {
  return page.evaluate(() => document.querySelector<ViewElement>("x3d")!.getCameraOrbit().radius);
}

describe("an approach", () => {
  const approaches: Record<string, (view: View) => Promise<void>> = {
    "by the wheel": async ({ page }) => {
      await page.mouse.move(center.x, center.y);
      for (let i = 0; i < 60; ++i) await page.mouse.wheel(0, -480);
    },
    "by two fingers": async (view) => {
      for (let i = 0; i < 8; ++i) {
        await touch(
          view,
          [10, 40, 80, 120, 160].map((half) => [
            [-half, 0],
            [half, 0],
          ]),
        );
      }
    },
  };
  for (const [name, approach] of Object.entries(approaches)) {
    soakTest(`${name} ends before the surface`, async () => {
      await withPage(siteOfGenerated("sphere"), { hasTouch: name === "by two fingers" }, async (view) => {
        await view.promise("complete");
        await approach(view);
        await settle(view.page);
        await approach(view); // with the surface known
        await settle(view.page);
        const nearest = await distance(view);
        assert.ok(nearest > 1 && nearest < 1.05, `the camera is ${nearest} from the center`);
      });
    });
  }
});
