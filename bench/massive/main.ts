// The rows of massive meshes in the browser: what views take on the line beside 3d-tiles-renderer, the first image beside
// the dragon's, a flight, a small budget, and a magenta backdrop. Prints Markdown tables.
//
//   scripts/bench massive [TRIANGLES...]      the rows of conversion, then these with a relief of 4,000,000 triangles
//   node bench/massive/main.ts [--rows view,first,flight,budget,closed] [--triangles N] [--runs N] [--site DIR]
//                              [--work DIR] [--pictures DIR] [--viewpoints NAME,...]
//
// --site measures a site of a relief that is there, without 3d-tiles-renderer. --work keeps the sites that are made.

import { existsSync, mkdirSync, mkdtempSync, rmSync } from "node:fs";
import { cpus, tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { parseArgs } from "node:util";
import { launchWarm } from "../load/measure.ts";
import { describeBrowser } from "../load/tasks.ts";
import { printClosed } from "./closedRow.ts";
import { printFlight } from "./flightRow.ts";
import { printSmallBudget } from "./budgetRow.ts";
import { dragonSite, reliefSite, viewpoints } from "./sites.ts";
import { tileBytes, writeTileset } from "./tileset.ts";
import { printFirstImages, printViews } from "./viewRow.ts";

const { values: options } = parseArgs({
  options: {
    rows: { type: "string", default: "view,first,flight,budget,closed" },
    triangles: { type: "string", default: "4000000" },
    runs: { type: "string", default: "3" },
    site: { type: "string" },
    work: { type: "string" },
    pictures: { type: "string" },
    viewpoints: { type: "string", default: Object.keys(viewpoints).join(",") },
  },
});
const rows = options.rows.split(",");
const runs = Number(options.runs);
const work = options.work === undefined ? mkdtempSync(join(tmpdir(), "imgeo-massive-")) : resolve(options.work);
if (options.pictures !== undefined) mkdirSync(options.pictures, { recursive: true });

async function tilesetOf(site: string): Promise<string> {
  const tileset = join(work, `tiles-${options.triangles}`);
  if (!existsSync(join(tileset, "tileset.json"))) {
    const count = await writeTileset(site, tileset);
    console.error(`${count} tiles, ${(tileBytes(tileset) / 1e6).toFixed(2)} MB`);
  }
  return tileset;
}

try {
  const site = options.site === undefined ? reliefSite(Number(options.triangles), work) : resolve(options.site);
  const tileset = rows.includes("view") && options.site === undefined ? await tilesetOf(site) : undefined;
  const browser = await launchWarm();
  try {
    const { pictures } = options;
    const names = options.viewpoints.split(",");
    if (rows.includes("view")) await printViews(browser, { site, tileset, work, runs, pictures, names });
    if (rows.includes("first")) await printFirstImages(browser, site, dragonSite(work), runs);
    if (rows.includes("flight")) await printFlight(browser, site);
    if (rows.includes("budget")) await printSmallBudget(browser, site);
    if (rows.includes("closed")) await printClosed(browser, site);
    console.log(
      `\nMedians of ${runs} cold loads; 20 Mbit/s, 40 ms, HTTP/1.1; 640 × 480 pixels; ${await describeBrowser(browser)}, ${cpus().length} cores; brotli where it helps.`,
    );
  } finally {
    await browser.close();
  }
} finally {
  if (options.work === undefined) rmSync(work, { recursive: true, force: true });
}
