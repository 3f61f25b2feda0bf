// A tab with a page of imgeo, and what the rows ask of it.

import type { Browser, Page } from "playwright-core";
import { timeoutMs, viewport } from "../load/measure.ts";

export interface Statistics {
  frames: number;
  openRequests: number;
  bufferBytes: number;
  textureBytes: number;
  levels: { groups: number; openGroups: number; bytes: number; errorInPixels: number };
}

/** `before`: scripts that run in the page before its own. Resolves when the page has its view. */
export async function openView(browser: Browser, url: string, ...before: (() => void)[]): Promise<Page> {
  const context = await browser.newContext({ viewport });
  const page = await context.newPage();
  for (const script of before) await page.addInitScript(script);
  await page.goto(url, { waitUntil: "commit", timeout: timeoutMs });
  await page.waitForFunction(() => "complete" in (document.querySelector("x3d") ?? {}), undefined, {
    timeout: timeoutMs,
  });
  return page;
}

export function statisticsOf(page: Page): Promise<Statistics> {
  return page.evaluate(() => (document.querySelector("x3d") as unknown as { statistics: Statistics }).statistics);
}
