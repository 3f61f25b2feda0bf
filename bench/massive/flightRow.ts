// A flight around a massive mesh over a slow line, three times around in a minute: memory, requests, tasks and frames.

import type { Browser } from "playwright-core";
import { countGpuBytes } from "../memory/gpuBytes.ts";
import { heapBytes } from "../memory/heap.ts";
import { serve } from "../load/measure.ts";
import { mainTasksOf, traceCategories, type Task, type TraceEvent } from "../load/trace.ts";
import { fly, type Flight } from "./flight.ts";
import { openView } from "./openView.ts";
import { sitePage, variantOf, withBudget } from "./sites.ts";
import { line } from "./viewRow.ts";

/** Less than the flight would take, so that groups leave the GPU. */
const megabytes = 24;
const [laps, lapSeconds] = [3, 20];

export async function printFlight(browser: Browser, site: string): Promise<void> {
  const page = sitePage(
    "flight",
    variantOf(site, "flight", (html) => withBudget(html, megabytes)),
  );
  const server = await serve(page);
  server.useLink(line);
  const tab = await openView(browser, server.origin, countGpuBytes);
  // Answers that wait, as the server sees them, and requests that the browser has begun.
  let [open, maxOpen] = [0, 0];
  tab.on("request", () => (maxOpen = Math.max(maxOpen, ++open)));
  for (const end of ["requestfinished", "requestfailed"] as const) tab.on(end as "requestfailed", () => --open);
  try {
    await tab.evaluate(() => (document.querySelector("x3d") as unknown as { complete: Promise<void> }).complete);
    [open, maxOpen] = [0, 0];
    console.log(
      "| lap | heap after it, MB | GPU at most, MB | requests | open at most | waiting or open | largest error at the end of a second: median / last, pixels | longest task, ms: by the clock | on the processor | caused by | frames | 50 % / 95 % of frames, ms |",
    );
    console.log("|--:|--:|--:|--:|--:|--:|--:|--:|--:|---|--:|--:|");
    console.log(`| before | ${((await heapBytes(tab)) / 1e6).toFixed(2)} | | | | | | | | | | |`);
    for (let lap = 1; lap <= laps; ++lap) {
      const requests = server.requests.length;
      await browser.startTracing(tab, { categories: traceCategories });
      const flight = await tab.evaluate(fly, lapSeconds);
      const { traceEvents } = JSON.parse((await browser.stopTracing()).toString()) as { traceEvents: TraceEvent[] };
      const counts = [server.requests.length - requests, maxOpen, flight.maxOpenRequests];
      const heap = await heapBytes(tab);
      printLap(lap, flight, heap, counts, mainTasksOf(traceEvents));
    }
    console.log(`\nBudget ${megabytes} MB.`);
  } finally {
    await tab.context().close();
    await server.close();
  }
}

function printLap(lap: number, flight: Flight, heap: number, counts: readonly number[], tasks: Task[]): void {
  const frames = flight.frameTimes.toSorted((a, b) => a - b);
  const errors = flight.errors.toSorted((a, b) => a - b);
  const percentile = (share: number): string => (frames[Math.floor(share * frames.length)] ?? 0).toFixed(0);
  const longest = (of: (task: Task) => number): Task =>
    tasks.reduce((found, task) => (of(task) > of(found) ? task : found));
  const onProcessor = longest((task) => task.processorMs);
  const cells = [
    lap,
    (heap / 1e6).toFixed(2),
    (flight.maxGpuBytes / 1e6).toFixed(2),
    ...counts,
    `${(errors[Math.floor(errors.length / 2)] ?? 0).toFixed(1)} / ${(flight.errors.at(-1) ?? 0).toFixed(1)}`,
    longest((task) => task.ms).ms.toFixed(0),
    onProcessor.processorMs.toFixed(0),
    onProcessor.cause,
    frames.length,
    `${percentile(0.5)} / ${percentile(0.95)}`,
  ];
  console.log(`| ${cells.join(" | ")} |`);
}
