// Paper section 7.3 repeated: how long bunny, horse and dragon take to load as
// SIG, as BG and inline, over three lines; then the longest tasks of the main
// thread on the largest of them, beside three.js with its two compressed formats.
// Prints Markdown tables.
//
//   scripts/bench load [MODEL...]

import { mkdtempSync, rmSync } from "node:fs";
import { cpus, tmpdir } from "node:os";
import { join } from "node:path";
import type { LineOptions } from "../../tests/browser/line.ts";
import { medianLoad, serve } from "./measure.ts";
import { prepareModels, type Model } from "./models.ts";
import { dracoPage, inlinePage, meshoptPage, sitePage, type BenchPage } from "./pages.ts";
import { describeBrowser, longestTasks } from "./tasks.ts";

const loads = Number(process.env.LOADS ?? 5);

const lines: Record<string, LineOptions | undefined> = {
  "unthrottled": undefined,
  "20 Mbit/s, 40 ms": { bitsPerSecond: 20e6, roundTripMs: 40 },
  "5 Mbit/s, 40 ms": { bitsPerSecond: 5e6, roundTripMs: 40 },
};

function print(...cells: (string | number)[]): void {
  console.log(`| ${cells.join(" | ")} |`);
}

async function printLoads(models: Model[], work: string): Promise<void> {
  print("model", "as", "kB", ...Object.keys(lines).map((line) => `${line}: first image / complete`));
  print("---", "---", "--:", ...Object.keys(lines).map(() => "--:"));
  for (const model of models) {
    for (const page of [sitePage(model, "sig"), sitePage(model, "bg"), inlinePage(model, join(work, model.name, "inline"))]) {
      await printPage(model.name, page);
    }
  }
}

async function printPage(model: string, page: BenchPage): Promise<void> {
  const server = await serve(page);
  try {
    const cells: string[] = [];
    let bytes = 0;
    for (const line of Object.values(lines)) {
      const load = await medianLoad(page, server, line, loads);
      bytes = load.bytes;
      const seconds = (ms: number): string => (ms / 1000).toFixed(2);
      cells.push(page.isProgressive ? `${seconds(load.firstImage)} / ${seconds(load.complete)} s` : `${seconds(load.complete)} s`);
    }
    print(model, page.name, Math.round(bytes / 1000), ...cells);
  } finally {
    await server.close();
  }
}

async function printTasks(model: Model, work: string): Promise<void> {
  const directory = (name: string): string => join(work, model.name, name);
  const pages = [sitePage(model, "sig"), sitePage(model, "bg"), await dracoPage(model, directory("draco")), await meshoptPage(model, directory("meshopt"))];
  console.log();
  print(`${model.name}: main thread, unthrottled`, "longest task", "longest on the processor", "tasks over 50 ms");
  print("---", "--:", "--:", "--:");
  for (const page of pages) {
    const server = await serve(page);
    try {
      const { longestMs, longestOnProcessorMs, longCount } = await longestTasks(page, server, loads);
      print(page.name, `${longestMs.toFixed(0)} ms`, `${longestOnProcessorMs.toFixed(0)} ms`, longCount);
    } finally {
      await server.close();
    }
  }
}

const work = mkdtempSync(join(tmpdir(), "imgeo-load-"));
try {
  const models = prepareModels(process.argv.slice(2), work);
  await printLoads(models, work);
  const largest = models.at(-1);
  if (largest) await printTasks(largest, work);
  console.log(`\nMedians of ${loads} cold loads; ${await describeBrowser()}, ${cpus().length} cores; brotli where it helps.`);
} finally {
  rmSync(work, { recursive: true, force: true });
}
