// The longest tasks of a page's main thread while it loads, from Chromium's own
// trace. A task holds up input and frames for as long as it lasts; of that, only
// the time on the processor is the page's doing where a renderer in software
// shares the machine.

import type { Browser, BrowserContext } from "playwright-core";
import type { TestServer } from "../../tests/browser/server.ts";
import { isDone, leastVertices, timeoutMs, viewport } from "./measure.ts";
import type { BenchPage } from "./pages.ts";
import { watch } from "./watch.ts";

export interface Tasks {
  /** Milliseconds from a task's begin to its end, and on the processor, each of the longest. */
  longestMs: number;
  longestOnProcessorMs: number;
  /** Tasks of more than 50 ms. */
  longCount: number;
}

/** An event of Chromium's trace, as far as we read it. */
export interface TraceEvent {
  name: string;
  ph: string;
  pid: number;
  tid: number;
  /** Microseconds; `tdur` on the processor. */
  ts: number;
  dur?: number;
  tdur?: number;
  args: { name?: string; data?: { url?: string } };
}

/** The medians of so many cold loads. */
export async function longestTasks(browser: Browser, page: BenchPage, server: TestServer, count: number): Promise<Tasks> {
  const runs: Tasks[] = [];
  server.useLine(undefined);
  for (let i = 0; i < count; ++i) {
    const context = await browser.newContext({ viewport });
    try {
      runs.push(tasksOf(await traceLoad(browser, context, page, server)));
    } finally {
      await context.close();
    }
  }
  const median = (of: (run: Tasks) => number): number => runs.map(of).sort((a, b) => a - b)[Math.floor(count / 2)]!;
  return {
    longestMs: median((run) => run.longestMs),
    longestOnProcessorMs: median((run) => run.longestOnProcessorMs),
    longCount: median((run) => run.longCount),
  };
}

async function traceLoad(browser: Browser, context: BrowserContext, page: BenchPage, server: TestServer): Promise<TraceEvent[]> {
  const tab = await context.newPage();
  await tab.addInitScript(watch, { saysWhenComplete: page.saysWhenComplete, leastVertices, takesPictures: false });
  await browser.startTracing(tab, { categories: ["toplevel", "devtools.timeline", "__metadata"] });
  await tab.goto(server.origin, { waitUntil: "commit", timeout: timeoutMs });
  await tab.waitForFunction(isDone, undefined, { timeout: timeoutMs, polling: 50 });
  const trace = JSON.parse((await browser.stopTracing()).toString()) as { traceEvents: TraceEvent[] };
  return trace.traceEvents;
}

/** From the first request of the page on: what comes before is the browser's own beginning. */
function tasksOf(events: TraceEvent[]): Tasks {
  const first = events.find(({ name, args }) => name === "ResourceSendRequest" && args.data?.url?.startsWith("http://127.0.0.1"));
  if (first === undefined) throw new Error("the trace has no request of the page");
  return longestTaskOf(events, first.ts);
}

/** Of the main threads of a trace's pages, from a time on. */
export function longestTaskOf(events: TraceEvent[], from = 0): Tasks {
  const mainThreads = new Set(events.filter(({ name, args }) => name === "thread_name" && args.name === "CrRendererMain").map(threadOf));
  const tasks = events.filter((event) =>
    event.ph === "X" && event.name.endsWith("RunTask") && event.ts >= from && mainThreads.has(threadOf(event)));
  const longest = (of: (task: TraceEvent) => number | undefined): number => Math.max(...tasks.map((task) => of(task) ?? 0)) / 1000;
  return {
    longestMs: longest(({ dur }) => dur),
    longestOnProcessorMs: longest(({ tdur }) => tdur),
    // A task appears twice, once for each of the two layers that run it.
    longCount: new Set(tasks.filter(({ dur = 0 }) => dur > 50_000).map(({ ts }) => Math.round(ts / 1000))).size,
  };
}

/** Milliseconds on the processor of all tasks of the pages' main threads and of their workers. */
export function processorMsOf(events: TraceEvent[]): number {
  const threads = new Set(events.filter(({ name, args }) =>
    name === "thread_name" && /^(CrRendererMain|DedicatedWorker thread)/.test(args.name ?? "")).map(threadOf));
  const tasks = events.filter((event) => event.ph === "X" && event.name.endsWith("RunTask") && threads.has(threadOf(event)))
    .toSorted((a, b) => a.ts - b.ts || (b.dur ?? 0) - (a.dur ?? 0));
  // A task appears once for each layer that runs it: only the outermost counts.
  const ends = new Map<string, number>();
  let sum = 0;
  for (const task of tasks) {
    if (task.ts < (ends.get(threadOf(task)) ?? 0)) continue;
    ends.set(threadOf(task), task.ts + (task.dur ?? 0));
    sum += task.tdur ?? 0;
  }
  return sum / 1000;
}

function threadOf({ pid, tid }: TraceEvent): string {
  return `${pid}/${tid}`;
}

/** The browser and what draws for it, for the foot of a table. */
export async function describeBrowser(browser: Browser): Promise<string> {
  const page = await browser.newPage();
  const renderer = await page.evaluate(() => {
    const gl = document.createElement("canvas").getContext("webgl2");
    const names = gl?.getExtension("WEBGL_debug_renderer_info");
    return gl && names ? String(gl.getParameter(names.UNMASKED_RENDERER_WEBGL)) : "no WebGL 2";
  });
  await page.close();
  return `Chromium ${browser.version()}, ${renderer}`;
}
