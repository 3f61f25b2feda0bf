// A page near a massive mesh whose memory holds a small part of what the view needs: it comes to rest, and fetches
// nothing twice.

import type { Browser } from "playwright-core";
import { serve } from "../load/measure.ts";
import { openView, statisticsOf } from "./openView.ts";
import { sitePage, variantOf, viewpoints, withBudget, withCamera } from "./sites.ts";

const megabytes = 8;
const restMs = 10_000;

export async function printSmallBudget(browser: Browser, site: string): Promise<void> {
  const page = sitePage(
    "small budget",
    variantOf(site, "budget", (html) => withBudget(withCamera(html, viewpoints["at the limb"]!), megabytes)),
  );
  const server = await serve(page);
  const tab = await openView(browser, server.origin);
  try {
    await tab.evaluate(() => (document.querySelector("x3d") as unknown as { complete: Promise<void> }).complete);
    await tab.waitForTimeout(restMs);
    const before = server.requests.length;
    const { frames } = await statisticsOf(tab);
    await tab.waitForTimeout(restMs);
    const after = await statisticsOf(tab);
    // Each worker of the runtime has its script fetched once more.
    const paths = server.requests.map(({ path }) => path).filter((path) => path.startsWith("/geometry/"));
    const cells = [
      `${(after.bufferBytes / 1e6).toFixed(2)} of ${megabytes}`,
      after.levels.errorInPixels.toFixed(1),
      paths.length,
      paths.length - new Set(paths).size,
      server.requests.length - before,
      after.frames - frames,
    ];
    console.log(
      "| GPU MB | largest error, pixels | files of the mesh | fetched twice | after 10 s at rest: requests | frames |",
    );
    console.log("|--:|--:|--:|--:|--:|--:|");
    console.log(`| ${cells.join(" | ")} |`);
  } finally {
    await tab.context().close();
    await server.close();
  }
}
