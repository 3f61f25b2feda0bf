// Measures how long decoding takes in a browser, and how long it blocks the page, for compact and for three.js'
// DRACOLoader and MeshoptDecoder with the same meshes in one run. First checks that each decoder returns as many
// triangles as the model has. Prints a Markdown table with ratios to Draco's times. Processor time is that of the page
// and its workers.
//
//   scripts/bench decode [MODEL...]

import { cpSync, mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { cpus, tmpdir } from "node:os";
import { join } from "node:path";
import { build } from "esbuild";
import type { Page } from "playwright-core";
import { launchChromium } from "../../tests/browser/chromium.ts";
import { repository } from "../../tests/browser/paths.ts";
import { startServer } from "../../tests/browser/server.ts";
import { meshOf, prepareModels } from "../load/models.ts";
import { describeBrowser } from "../load/tasks.ts";
import { longestTaskMsOf, processorMsOf, traceCategories, type TraceEvent } from "../load/trace.ts";
import { inputsOf } from "./inputs.ts";
import type {} from "./page.ts";

const runs = Number(process.env.RUNS ?? 9);

async function writePage(directory: string): Promise<void> {
  mkdirSync(directory);
  const bundle = { bundle: true, format: "esm", target: "es2022", minify: true, logLevel: "warning" } as const;
  await build({
    ...bundle,
    entryPoints: [join(repository, "bench/decode/page.ts")],
    outfile: join(directory, "page.js"),
  });
  await build({
    ...bundle,
    entryPoints: [join(repository, "web/src/workers/worker.ts")],
    outfile: join(directory, "imgeo-worker.js"),
  });
  cpSync(join(repository, "node_modules/three/examples/jsm/libs/draco"), join(directory, "draco"), { recursive: true });
  writeFileSync(
    join(directory, "index.html"),
    '<!doctype html><meta charset="utf-8"><title>decode</title><script type="module" src="page.js"></script>',
  );
}

/** Loads a decoder's files into the page. */
async function loadFiles(page: Page, decoder: string, files: readonly Buffer[]): Promise<void> {
  await page.evaluate(
    ({ decoder, texts }) => {
      window.files[decoder] = texts.map((text) => Uint8Array.from(atob(text), (character) => character.charCodeAt(0)));
    },
    { decoder, texts: files.map((file) => file.toString("base64")) },
  );
}

async function decode(page: Page, decoder: string): Promise<{ ms: number; triangles: number }> {
  return page.evaluate(async (decoder) => {
    const start = performance.now();
    const { triangles } = await window.decoders[decoder]!(window.files[decoder]!);
    return { ms: performance.now() - start, triangles };
  }, decoder);
}

const median = (values: number[]): number => values.toSorted((a, b) => a - b)[Math.floor(values.length / 2)]!;

/** One row of the table. */
async function measure(page: Page, decoder: string, files: readonly Buffer[], triangles: number) {
  await loadFiles(page, decoder, files);
  const first = await decode(page, decoder);
  // Draco and gltfpack drop triangles that have become degenerate with 16-bit positions.
  if (Math.abs(first.triangles - triangles) > triangles / 100)
    throw new Error(`${decoder} gives ${first.triangles} triangles of ${triangles}`);
  const times: number[] = [];
  for (let run = 0; run < runs; ++run) times.push((await decode(page, decoder)).ms);
  const traces: TraceEvent[][] = [];
  for (let run = 0; run < 3; ++run) traces.push(await traceOf(page, decoder));
  const bytes = files.reduce((sum, { length }) => sum + length, 0);
  return {
    decoder,
    bytes,
    first: first.ms,
    warm: median(times),
    processor: median(traces.map(processorMsOf)),
    task: median(traces.map(longestTaskMsOf)),
  };
}

async function traceOf(page: Page, decoder: string): Promise<TraceEvent[]> {
  const browser = page.context().browser()!;
  await browser.startTracing(page, { categories: traceCategories });
  await decode(page, decoder);
  return (JSON.parse((await browser.stopTracing()).toString()) as { traceEvents: TraceEvent[] }).traceEvents;
}

const work = mkdtempSync(join(tmpdir(), "imgeo-decode-"));
const browser = await launchChromium();
try {
  const models = prepareModels(process.argv.slice(2), work);
  await writePage(join(work, "page"));
  const server = await startServer(join(work, "page"));
  server.contentPolicy = "default-src 'self' 'unsafe-eval' blob: data:"; // what the other two need
  console.log("| model | decoder | bytes | first decode | median | on the processor | longest task of the page |");
  console.log("|---|---|--:|--:|--:|--:|--:|");
  for (const model of models) {
    const triangles = meshOf(model).triangles.length / 3;
    const inputs = inputsOf(model, join(work, model.name));
    const page = await browser.newPage();
    await page.goto(server.origin);
    await page.waitForFunction(() => "decoders" in window);
    const rows = [];
    for (const [decoder, files] of Object.entries(inputs)) rows.push(await measure(page, decoder, files, triangles));
    const draco = rows.find(({ decoder }) => decoder === "draco")!;
    const ms = (value: number): string => `${value.toFixed(value < 10 ? 1 : 0)} ms`;
    const withRatio = (value: number, dracoValue: number): string =>
      `${ms(value)} (${(value / dracoValue).toFixed(2)})`;
    for (const { decoder, bytes, first, warm, processor, task } of rows) {
      console.log(
        `| ${[model.name, decoder, bytes, ms(first), withRatio(warm, draco.warm), withRatio(processor, draco.processor), ms(task)].join(" | ")} |`,
      );
    }
    await page.close();
  }
  await server.close();
  console.log(
    `\nMedians of ${runs} decodes after the first; ${await describeBrowser(browser)}, ${cpus().length} cores.`,
  );
} finally {
  await browser.close();
  rmSync(work, { recursive: true, force: true });
}
