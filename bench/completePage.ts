// Opens a page and waits until its scene is complete, for benchmarks of what happens afterwards.

import type { Page } from "playwright-core";
import type { ViewElement } from "../web/src/dom/imgeoView.ts";

/** Navigates to `url` and resolves when the scene's promise `complete` does. */
export async function goUntilComplete(page: Page, url: string, timeoutMs: number): Promise<void> {
  page.setDefaultTimeout(timeoutMs);
  await page.goto(url);
  await page.evaluate(async () => {
    const x3d = document.querySelector<Partial<ViewElement> & Element>("x3d")!;
    while (x3d.complete === undefined)
      await new Promise((resolve) => {
        setTimeout(resolve, 50);
      });
    await x3d.complete;
  });
}
