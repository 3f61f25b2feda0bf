// A page that has become whole, for benchmarks of what it costs from then on.

import type { Page } from "playwright-core";
import type { ViewElement } from "../web/src/dom/imgeoView.ts";

/** Goes there, and waits until its scene has told that it is complete. */
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
