// Documents that move are compared at one moment. Their interpolators follow one TimeSensor, DEF="clock", whose fraction
// a script sets.

import type { Page } from "playwright-core";
import type { Runtime } from "./runtimes.ts";

/** The fraction of the clock, 0 … 1, by document. */
export const moments: Readonly<Record<string, number>> = {
  "Animation-geometry": 0.3,
  "Animation-linear": 0.35,
  "Animation-skin": 0.6,
  "Animation-spline": 0.4,
  "Animation-squad-ease": 0.45,
  "Animation-utilities": 0.5,
  "Animation-view-light": 0.7,
};

interface CanvasOfXIte extends Element {
  readonly browser: { readonly currentScene: { getNamedNode: (name: string) => Record<string, unknown> } };
}

/** Sets the clock of a document that the page displays. */
export async function goTo(page: Page, runtime: Runtime, fraction: number): Promise<void> {
  if (runtime === "X_ITE") {
    await page.waitForFunction((value) => {
      const canvas = document.querySelector<CanvasOfXIte>("x3d-canvas");
      if (canvas === null) return false;
      try {
        canvas.browser.currentScene.getNamedNode("clock").set_fraction = value;
        return true;
      } catch {
        return false; // the document is not loaded yet
      }
    }, fraction);
    return;
  }
  if (runtime === "imgeo")
    await page.waitForFunction(() => "getFieldValue" in (document.querySelector('[DEF="clock"]') ?? {}));
  await page.evaluate((value) => {
    document.querySelector('[DEF="clock"]')?.setAttribute("set_fraction", String(value));
  }, fraction);
}
