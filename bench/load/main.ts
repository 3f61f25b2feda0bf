// Repeats paper section 7.3: measures how long bunny, horse and dragon take to load as SIG, as BG and inline over
// three connections, and compares them with what three.js users have; then measures the longest tasks of the main
// thread for the largest of the models. Prints Markdown tables.
//
//   scripts/bench load [--runs N] [--tasks] [MODEL...]     --tasks: only the last table

import { mkdtempSync, rmSync } from "node:fs";
import { cpus, tmpdir } from "node:os";
import { join } from "node:path";
import { parseArgs } from "node:util";
import type { LinkOptions } from "../../tests/browser/networkLink.ts";
import { launchWarm, medianLoad, serve } from "./measure.ts";
import { containers, prepareModels, type Container, type Model } from "./models.ts";
import { dracoPage, inlinePage, lod2Page, meshoptPage, sitePage, type BenchPage } from "./pages.ts";
import { describeBrowser, longestTasks } from "./tasks.ts";

const { values: options, positionals: modelNames } = parseArgs({
  options: { runs: { type: "string", default: "5" }, tasks: { type: "boolean", default: false } },
  allowPositionals: true,
});
const runs = Number(options.runs);
if (!Number.isInteger(runs) || runs < 1) throw new Error(`--runs ${options.runs} is not a number of loads`);

const connections: Record<string, LinkOptions | undefined> = {
  unthrottled: undefined,
  "20 Mbit/s, 40 ms": { bitsPerSecond: 20e6, roundTripMs: 40 },
  "5 Mbit/s, 40 ms": { bitsPerSecond: 5e6, roundTripMs: 40 },
};

function print(...cells: (string | number)[]): void {
  console.log(`| ${cells.join(" | ")} |`);
}

/** The page's physical limit: its bytes at the line's rate, after the round trips of connection, page and first files. */
function limitMsOf(bytes: number, { bitsPerSecond, roundTripMs }: LinkOptions): number {
  return (8000 * bytes) / bitsPerSecond + 3 * roundTripMs;
}

async function withServer(
  page: BenchPage,
  use: (server: Awaited<ReturnType<typeof serve>>) => Promise<void>,
): Promise<void> {
  const server = await serve(page);
  try {
    await use(server);
  } finally {
    await server.close();
  }
}

async function pagesOf(model: Model, work: string): Promise<Record<"ours" | "others" | "inline", BenchPage[]>> {
  const directory = (name: string): string => join(work, model.name, name);
  return {
    ours: (Object.keys(containers) as Container[]).map((container) => sitePage(model, container)),
    inline: [inlinePage(model, directory("inline"))],
    others: [
      await dracoPage(model, directory("draco")),
      await meshoptPage(model, directory("meshopt")),
      await lod2Page(model, directory("lod2")),
    ],
  };
}

async function printLoads(model: string, page: BenchPage): Promise<void> {
  await withServer(page, async (server) => {
    const cells: string[] = [];
    let sent = 0;
    for (const connection of Object.values(connections)) {
      const { first, nearlyFinal, final, bytes, idle } = await medianLoad(browser, page, server, connection, runs);
      sent = bytes;
      const seconds = (ms: number): string => (ms / 1000).toFixed(2);
      cells.push(first === final ? seconds(final) : [first, nearlyFinal, final].map(seconds).join(" / "));
      if (connection !== undefined) cells.push(seconds(limitMsOf(bytes, connection)), seconds(idle));
    }
    print(model, page.name, Math.round(sent / 1000), ...cells);
  });
}

async function printTasks(page: BenchPage): Promise<void> {
  await withServer(page, async (server) => {
    const { longest, longestOfLoading, longestMs } = await longestTasks(browser, page, server, runs);
    const cells = [longest, longestOfLoading].flatMap(({ processorMs, cause }) => [processorMs.toFixed(0), cause]);
    print(page.name, longestMs.toFixed(0), ...cells);
  });
}

const browser = await launchWarm();
const work = mkdtempSync(join(tmpdir(), "imgeo-load-"));
try {
  const models = prepareModels(modelNames, work);
  if (!options.tasks) {
    print(
      "model",
      "format",
      "kB",
      ...Object.entries(connections).flatMap(([name, connection]) => [
        `${name}: first / 90 % / final image, s`,
        ...(connection ? ["limit of the line, s", "line idle, s"] : []),
      ]),
    );
    print(
      "---",
      "---",
      "--:",
      ...Object.values(connections).flatMap((link) => (link ? ["--:", "--:", "--:"] : ["--:"])),
    );
  }
  let largest: { model: Model; pages: BenchPage[] } | undefined;
  for (const model of models) {
    const { ours, inline, others } = await pagesOf(model, work);
    for (const page of options.tasks ? [] : [...ours, ...inline, ...others]) await printLoads(model.name, page);
    largest = { model, pages: [...ours, ...others] };
  }
  if (largest) {
    console.log();
    print(
      `${largest.model.name}: main thread, unthrottled`,
      "longest task, ms",
      "longest on the processor, ms",
      "caused by",
      "longest except starts, ms",
      "caused by",
    );
    print("---", "--:", "--:", "---", "--:", "---");
    for (const page of largest.pages) await printTasks(page);
  }
  console.log(
    `\nMedians of ${runs} cold loads, a single load where the first image takes over 2.5 s; ${await describeBrowser(browser)}, ${cpus().length} cores; brotli where it helps.`,
  );
} finally {
  await browser.close();
  rmSync(work, { recursive: true, force: true });
}
