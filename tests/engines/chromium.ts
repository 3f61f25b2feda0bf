// Chromium, whose pictures those of the other engines are compared with.

import { launchTestChromium } from "../browser/chromium.ts";
import type { Engine, EnginePage, Size } from "./engine.ts";

async function open(size: Size): Promise<EnginePage> {
  const browser = await launchTestChromium();
  const page = await browser.newPage({ viewport: size });
  return {
    async goTo(url) {
      await page.goto(url);
    },
    evaluate: (expression) => page.evaluate<unknown>(expression),
    picture: () => page.screenshot(),
    async drag([first = [0, 0], ...others]) {
      await page.mouse.move(...first);
      await page.mouse.down();
      for (const point of others) await page.mouse.move(...point);
      await page.mouse.up();
    },
    close: () => browser.close(),
  };
}

export const chromium: Engine = { name: "Chromium", open };
