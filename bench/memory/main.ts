// Measures what a page with a model holds in memory when everything has loaded, and the most that its renderer process
// has held, beside three.js with Draco and with meshopt. Each load has a browser of its own. Prints a Markdown table of
// medians: the JavaScript heap after a garbage collection with the memory of array buffers, of the page and its workers,
// as V8 states it; the bytes of live WebGL buffers and textures, counted from the page's calls; and the peak of the
// renderer's resident memory, as the kernel states it.
//
//   scripts/bench memory [MODEL...]        RUNS=5: medians of five

import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { cpus, tmpdir } from "node:os";
import { join } from "node:path";
import type { Browser, Page } from "playwright-core";
import { launchChromium } from "../../tests/browser/chromium.ts";
import { load, openTab, serve } from "../load/measure.ts";
import { prepareModels, type Model } from "../load/models.ts";
import { dracoPage, meshoptPage, sitePage, type BenchPage } from "../load/pages.ts";
import { countGpuBytes, type GpuCount } from "./gpuBytes.ts";
import { heapBytes } from "./heap.ts";

const runs = Number(process.env.RUNS ?? 3);
/** Time after the last picture in which a page frees what it no longer needs. */
const restMs = 3000;

interface Memory {
  heap: number;
  gpu: number;
  peak: number;
}

/** The largest resident memory so far of the browser's renderer process with the most. */
async function rendererPeak(browser: Browser): Promise<number> {
  const session = await browser.newBrowserCDPSession();
  const { processInfo } = await session.send("SystemInfo.getProcessInfo");
  await session.detach();
  const peaks = processInfo
    .filter(({ type }) => type === "renderer")
    .map(({ id }) => 1024 * Number(/VmHWM:\s*(\d+)/.exec(readFileSync(`/proc/${id}/status`, "utf8"))?.[1] ?? 0));
  return Math.max(...peaks);
}

async function blankPeak(): Promise<number> {
  const browser = await launchChromium();
  try {
    await browser.newPage();
    return await rendererPeak(browser);
  } finally {
    await browser.close();
  }
}

async function measure(bench: BenchPage): Promise<Memory> {
  const server = await serve(bench);
  const browser = await launchChromium();
  try {
    const tab: Page = await openTab(await browser.newContext(), bench, false);
    await tab.addInitScript(countGpuBytes);
    await load(tab, bench, server);
    await tab.waitForTimeout(restMs);
    const peak = await rendererPeak(browser);
    const gpu = await tab.evaluate(() => (window as unknown as GpuCount).gpuBytes);
    const heap = await heapBytes(tab);
    return { heap, gpu, peak };
  } finally {
    await browser.close();
    await server.close();
  }
}

async function pagesOf(model: Model, work: string): Promise<BenchPage[]> {
  return [
    await dracoPage(model, join(work, model.name, "draco")),
    sitePage(model, "SIG compact"),
    sitePage(model, "SIG classic"),
    sitePage(model, "BG"),
    await meshoptPage(model, join(work, model.name, "meshopt")),
  ];
}

const work = mkdtempSync(join(tmpdir(), "imgeo-memory-"));
try {
  const blank = await blankPeak();
  console.log(
    "| model | page | heap, MB | GPU, MB | both, of Draco's | peak of the renderer, MB | of Draco's | above a blank page's |",
  );
  console.log("|---|---|--:|--:|--:|--:|--:|--:|");
  for (const model of prepareModels(process.argv.length > 2 ? process.argv.slice(2) : ["dragon"], work)) {
    const pages = await pagesOf(model, work);
    const measured = pages.map((): Memory[] => []);
    for (let run = 0; run < runs; ++run)
      for (const [i, page] of pages.entries()) measured[i]!.push(await measure(page));
    const median = (all: Memory[], of: (memory: Memory) => number): number =>
      all.map(of).sort((a, b) => a - b)[Math.floor(all.length / 2)]!;
    const rows = measured.map((all) => ({
      heap: median(all, ({ heap }) => heap),
      gpu: median(all, ({ gpu }) => gpu),
      peak: median(all, ({ peak }) => peak),
    }));
    const draco = rows[0]!;
    for (const [i, { heap, gpu, peak }] of rows.entries()) {
      const cells = [
        (heap / 1e6).toFixed(1),
        (gpu / 1e6).toFixed(1),
        ((heap + gpu) / (draco.heap + draco.gpu)).toFixed(2),
        (peak / 1e6).toFixed(0),
        (peak / draco.peak).toFixed(2),
        `${((peak - blank) / 1e6).toFixed(0)} (${((peak - blank) / (draco.peak - blank)).toFixed(2)})`,
      ];
      console.log(`| ${[model.name, pages[i]!.name, ...cells].join(" | ")} |`);
    }
  }
  console.log(
    `\nMedians of ${runs}; ${cpus().length} cores; a blank page's renderer holds ${(blank / 1e6).toFixed(0)} MB.`,
  );
} finally {
  rmSync(work, { recursive: true, force: true });
}
