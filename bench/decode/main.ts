// Measures how long decoding takes in a browser, and how long it blocks the page: for compact in TypeScript and in
// WebAssembly, and for three.js' DRACOLoader and MeshoptDecoder, with the same meshes in one run. "Cold" is the first
// decode of a browser that has just started, which is what a page that loads waits for; clocks start when the workers
// have started. Compact is measured with one worker and with as many as pages use; the other two decode a file in one.
// First checks that each decoder returns as many triangles as the model has. Prints a Markdown table with ratios to
// Draco's times. Processor time is that of the page and its workers.
//
//   scripts/bench decode [MODEL...]        STARTS=5: browsers for each row; RUNS=5: decodes in each after the first

import { cpSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { cpus, tmpdir } from "node:os";
import { join } from "node:path";
import { brotliCompressSync } from "node:zlib";
import { build } from "esbuild";
import type { Page } from "playwright-core";
import { launchChromium } from "../../tests/browser/chromium.ts";
import { repository } from "../../tests/browser/paths.ts";
import { startServer } from "../../tests/browser/server.ts";
import { bundleWorker } from "../../web/bundle.ts";
import { meshOf, prepareModels } from "../load/models.ts";
import { describeBrowser } from "../load/tasks.ts";
import { longestTaskMsOf, processorMsOf, traceCategories, type TraceEvent } from "../load/trace.ts";
import { inputsOf, type DecoderName } from "./inputs.ts";
import type {} from "./page.ts";

const starts = Number(process.env.STARTS ?? 5);
const runs = Number(process.env.RUNS ?? 5);
/** Milliseconds that workers have to start. */
const startMs = Number(process.env.START_MS ?? 1000);
const pool = Math.min(4, Math.max(2, cpus().length - 1)); // as in web/src/workers/pageWorkers.ts

interface Way {
  readonly decoder: DecoderName;
  readonly name: string;
  readonly workers: number;
}

const ways: readonly Way[] = [
  { decoder: "typescript", name: "compact, TypeScript", workers: 1 },
  { decoder: "wasm", name: "compact, WebAssembly", workers: 1 },
  { decoder: "typescript", name: "compact, TypeScript", workers: pool },
  { decoder: "wasm", name: "compact, WebAssembly", workers: pool },
  { decoder: "draco", name: "DRACOLoader", workers: 1 },
  { decoder: "meshopt", name: "MeshoptDecoder", workers: 1 },
];

const decoderModule = join(repository, "web/dist/imgeo-decoder.wasm");

async function writePage(directory: string): Promise<void> {
  mkdirSync(directory);
  await build({
    bundle: true,
    format: "esm",
    target: "es2022",
    minify: true,
    logLevel: "warning",
    entryPoints: [join(repository, "bench/decode/page.ts")],
    outfile: join(directory, "page.js"),
  });
  writeFileSync(join(directory, "imgeo-worker.js"), await bundleWorker());
  cpSync(decoderModule, join(directory, "imgeo-decoder.wasm"));
  cpSync(join(repository, "node_modules/three/examples/jsm/libs/draco"), join(directory, "draco"), { recursive: true });
  writeFileSync(
    join(directory, "index.html"),
    '<!doctype html><meta charset="utf-8"><title>decode</title><script type="module" src="page.js"></script>',
  );
}

/** Loads files into the page. */
async function loadFiles(page: Page, files: readonly Buffer[]): Promise<void> {
  await page.evaluate(
    (texts) => {
      window.files = texts.map((text) => Uint8Array.from(atob(text), (character) => character.charCodeAt(0)));
    },
    files.map((file) => file.toString("base64")),
  );
}

async function decode(page: Page): Promise<{ ms: number; triangles: number }> {
  return page.evaluate(async () => {
    const start = performance.now();
    const { triangles } = await window.decode(window.files);
    return { ms: performance.now() - start, triangles };
  });
}

const median = (values: readonly number[]): number => values.toSorted((a, b) => a - b)[Math.floor(values.length / 2)]!;

interface Times {
  readonly cold: number;
  readonly warm: number;
  readonly processor: number;
  readonly task: number;
}

/** Decodes in a browser that has just started. */
async function timesOf(origin: string, way: Way, files: readonly Buffer[], triangles: number): Promise<Times> {
  const browser = await launchChromium();
  try {
    const page = await browser.newPage();
    await page.goto(`${origin}?decoder=${way.decoder}&workers=${way.workers}&start=${startMs}`);
    await page.waitForFunction(() => "ready" in window);
    await loadFiles(page, files);
    await page.evaluate(() => window.ready);
    const first = await decode(page);
    // Draco and gltfpack drop triangles that have become degenerate with 16-bit positions.
    if (Math.abs(first.triangles - triangles) > triangles / 100)
      throw new Error(`${way.name} gives ${first.triangles} triangles of ${triangles}`);
    const later: number[] = [];
    for (let run = 0; run < runs; ++run) later.push((await decode(page)).ms);
    const events = await traceOf(page);
    return { cold: first.ms, warm: median(later), processor: processorMsOf(events), task: longestTaskMsOf(events) };
  } finally {
    await browser.close();
  }
}

async function traceOf(page: Page): Promise<TraceEvent[]> {
  const browser = page.context().browser()!;
  await browser.startTracing(page, { categories: traceCategories });
  await decode(page);
  return (JSON.parse((await browser.stopTracing()).toString()) as { traceEvents: TraceEvent[] }).traceEvents;
}

/** The medians of all starts. The ways take turns, so that they share what else the machine does. */
async function measure(origin: string, inputs: Record<DecoderName, Buffer[]>, triangles: number) {
  const all = ways.map((): Times[] => []);
  for (let start = 0; start < starts; ++start)
    for (const [i, way] of ways.entries()) all[i]!.push(await timesOf(origin, way, inputs[way.decoder], triangles));
  return ways.map((way, i) => {
    const medianOf = (key: keyof Times): number => median(all[i]!.map((times) => times[key]));
    const bytes = inputs[way.decoder].reduce((sum, { length }) => sum + length, 0);
    return {
      way,
      bytes,
      cold: medianOf("cold"),
      warm: medianOf("warm"),
      processor: medianOf("processor"),
      task: medianOf("task"),
    };
  });
}

const work = mkdtempSync(join(tmpdir(), "imgeo-decode-"));
try {
  const models = prepareModels(process.argv.slice(2), work);
  await writePage(join(work, "page"));
  const server = await startServer(join(work, "page"));
  server.contentPolicy = "default-src 'self' 'unsafe-eval' blob: data:"; // what the other two need
  console.log(
    "| model | decoder | workers | bytes | cold | warm | warm, on the processor | longest task of the page |",
  );
  console.log("|---|---|--:|--:|--:|--:|--:|--:|");
  for (const model of models) {
    const triangles = meshOf(model).triangles.length / 3;
    const rows = await measure(server.origin, inputsOf(model, join(work, model.name)), triangles);
    const draco = rows.find(({ way }) => way.decoder === "draco")!;
    const ms = (value: number): string => `${value.toFixed(value < 10 ? 1 : 0)} ms`;
    const withRatio = (value: number, dracoValue: number): string =>
      `${ms(value)} (${(value / dracoValue).toFixed(2)})`;
    for (const { way, bytes, cold, warm, processor, task } of rows) {
      const columns = [
        model.name,
        way.name,
        way.workers,
        bytes,
        withRatio(cold, draco.cold),
        withRatio(warm, draco.warm),
        withRatio(processor, draco.processor),
        ms(task),
      ];
      console.log(`| ${columns.join(" | ")} |`);
    }
  }
  await server.close();
  const bytes = readFileSync(decoderModule);
  const browser = await launchChromium();
  console.log(
    `\nMedians of ${starts} starts of a browser, and of ${runs} decodes in each after the first; ` +
      `${await describeBrowser(browser)}, ${cpus().length} cores. The module in WebAssembly: ${bytes.length} bytes, ` +
      `${brotliCompressSync(bytes).length} in brotli.`,
  );
  await browser.close();
} finally {
  rmSync(work, { recursive: true, force: true });
}
