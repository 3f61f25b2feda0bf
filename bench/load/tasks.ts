// Finds the longest tasks of a page's main thread while it loads, from Chromium's trace. A task delays input and
// frames for its whole duration; with a software renderer on the same machine, only its processor time is caused by
// the page.

import type { Browser, BrowserContext } from "playwright-core";
import type { TestServer } from "../../tests/browser/server.ts";
import { load, openTab, viewport } from "./measure.ts";
import type { BenchPage } from "./pages.ts";
import { mainTasksOf, traceCategories, type Task, type TraceEvent } from "./trace.ts";

export interface Tasks {
  /**
   * The task with the longest processor time, of all tasks and of those that load and draw the model (not starting
   * scripts).
   */
  longest: Task;
  longestOfLoading: Task;
  /** Maximum duration of a task in milliseconds. */
  longestMs: number;
}

/** Medians over `count` cold loads. */
export async function longestTasks(
  browser: Browser,
  page: BenchPage,
  server: TestServer,
  count: number,
): Promise<Tasks> {
  const runs: Task[][] = [];
  server.useLink(undefined);
  for (let i = 0; i < count; ++i) {
    const context = await browser.newContext({ viewport });
    try {
      runs.push(tasksOf(await traceLoad(browser, context, page, server)));
    } finally {
      await context.close();
    }
  }
  const isStart = ({ cause }: Task): boolean => cause.startsWith("start");
  return {
    longest: medianOf(
      runs.map((tasks) => longestOf(tasks, byProcessor)),
      byProcessor,
    ),
    longestOfLoading: medianOf(
      runs.map((tasks) =>
        longestOf(
          tasks.filter((task) => !isStart(task)),
          byProcessor,
        ),
      ),
      byProcessor,
    ),
    longestMs: medianOf(
      runs.map((tasks) => longestOf(tasks, byClock)),
      byClock,
    ).ms,
  };
}

const byProcessor = (task: Task): number => task.processorMs;
const byClock = (task: Task): number => task.ms;

function longestOf(tasks: readonly Task[], measure: (task: Task) => number): Task {
  return tasks.reduce((longest, task) => (measure(task) > measure(longest) ? task : longest));
}

function medianOf(tasks: readonly Task[], measure: (task: Task) => number): Task {
  return tasks.toSorted((a, b) => measure(a) - measure(b))[Math.floor(tasks.length / 2)]!;
}

async function traceLoad(
  browser: Browser,
  context: BrowserContext,
  page: BenchPage,
  server: TestServer,
): Promise<TraceEvent[]> {
  const tab = await openTab(context, page, false);
  await browser.startTracing(tab, { categories: traceCategories });
  await load(tab, page, server);
  const trace = JSON.parse((await browser.stopTracing()).toString()) as { traceEvents: TraceEvent[] };
  return trace.traceEvents;
}

/** Tasks after the first request of the page; earlier tasks belong to the start of the browser. */
function tasksOf(events: TraceEvent[]): Task[] {
  const first = events.find(
    ({ name, args }) => name === "ResourceSendRequest" && args.data?.url?.startsWith("http://127.0.0.1"),
  );
  if (first === undefined) throw new Error("the trace has no request of the page");
  return mainTasksOf(events, first.ts);
}

/** Browser version and renderer, for the note below a table. */
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
