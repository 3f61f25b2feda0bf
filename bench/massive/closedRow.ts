// Pictures of each frame of a slow load and of a flight against a magenta backdrop: none of it is seen inside of the
// silhouette.

import type { Browser } from "playwright-core";
import { countGpuBytes } from "../memory/gpuBytes.ts";
import { serve } from "../load/measure.ts";
import { fly } from "./flight.ts";
import { countHoles, type HoleCount } from "./holes.ts";
import { openView } from "./openView.ts";
import { sitePage, variantOf, withBudget } from "./sites.ts";

const flightSeconds = 20;

export async function printClosed(browser: Browser, site: string): Promise<void> {
  const onMagenta = (html: string): string => withBudget(html.replace(/skyColor="[^"]*"/i, 'skyColor="1 0 1"'), 24);
  const page = sitePage("magenta", variantOf(site, "magenta", onMagenta));
  const server = await serve(page);
  server.useLink({ bitsPerSecond: 3e6, roundTripMs: 40 });
  const tab = await openView(browser, server.origin, countGpuBytes, countHoles);
  const counted = (): Promise<HoleCount> => tab.evaluate(() => (window as unknown as { holes: HoleCount }).holes);
  try {
    await tab.evaluate(() => (document.querySelector("x3d") as unknown as { complete: Promise<void> }).complete);
    const load = await counted();
    await tab.evaluate(fly, flightSeconds);
    const all = await counted();
    console.log("| magenta backdrop | frames | pixels of the silhouette | of the backdrop inside of it |");
    console.log("|---|--:|--:|--:|");
    console.log(`| load at 3 Mbit/s | ${load.frames} | ${load.covered} | ${load.holes} |`);
    console.log(
      `| flight of ${flightSeconds} s | ${all.frames - load.frames} | ${all.covered - load.covered} | ${all.holes - load.holes} |`,
    );
  } finally {
    await tab.context().close();
    await server.close();
  }
}
