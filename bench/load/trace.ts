// Extracts the tasks of a page's main thread from Chromium's trace: the duration of each and its main cause.

/** The fields of a Chromium trace event that are used here. */
export interface TraceEvent {
  name: string;
  ph: string;
  pid: number;
  tid: number;
  /** Microseconds; `tdur` is processor time. */
  ts: number;
  dur?: number;
  tdur?: number;
  args: { name?: string; data?: { url?: string } };
}

/** Trace categories of the events that are used here. */
export const traceCategories = ["toplevel", "devtools.timeline", "v8", "__metadata"];

export interface Task {
  /** Duration, and processor time, in milliseconds. */
  ms: number;
  processorMs: number;
  /** Cause of the largest share of it. */
  cause: Cause;
}

/** Causes by event name. */
const causes = {
  "v8.evaluateModule": "start of the module",
  EvaluateScript: "start of a script",
  FireAnimationFrame: "a frame",
  TimerFire: "a timer",
  HandlePostMessage: "a worker's answer",
  RunMicrotasks: "promises",
  FunctionCall: "a callback",
  ParseHTML: "the document",
  MajorGC: "garbage",
  MinorGC: "garbage",
  "Receive mojo message": "the browser's own",
} as const;
export type Cause = (typeof causes)[keyof typeof causes] | "unknown";

/** V8 looks up source positions when the tracing inspector needs a stack; without tracing this does not happen. */
const inspectorsEvent = "V8.CollectSourcePositions";

/** Tasks of the main threads of a trace's pages that begin at `from` (microseconds) or later. */
export function mainTasksOf(events: readonly TraceEvent[], from = 0): Task[] {
  const mainThreads = new Set(
    events.filter(({ name, args }) => name === "thread_name" && args.name === "CrRendererMain").map(threadOf),
  );
  const threads = new Map(Array.from(mainThreads, (thread) => [thread, [] as TraceEvent[]]));
  for (const event of events) if (event.ph === "X" && event.ts >= from) threads.get(threadOf(event))?.push(event);
  return Array.from(threads.values()).flatMap((own) => {
    own.sort(byBegin);
    return tasksOf(outermostTasks(own), own);
  });
}

/** Removes nested entries: a task appears once for each layer that runs it. */
function outermostTasks(sorted: readonly TraceEvent[]): TraceEvent[] {
  let end = 0;
  return sorted.filter((event) => {
    if (!event.name.endsWith("RunTask") || event.ts < end) return false;
    end = endOf(event);
    return true;
  });
}

/**
 * Durations and causes of `tasks`, which are sorted and disjoint. The events inside a task are contiguous in `sorted`,
 * so one pass is enough.
 */
function tasksOf(tasks: readonly TraceEvent[], sorted: readonly TraceEvent[]): Task[] {
  let next = 0;
  return tasks.map((task) => {
    let main: TraceEvent | undefined;
    let inspectorTime = 0;
    for (let event = sorted[next]; event !== undefined && event.ts < endOf(task); event = sorted[++next]) {
      if (event.ts < task.ts || endOf(event) > endOf(task)) continue;
      if (event.name === inspectorsEvent) inspectorTime += onProcessor(event);
      if (event.name in causes && (main === undefined || onProcessor(event) > onProcessor(main))) main = event;
    }
    return {
      ms: (task.dur ?? 0) / 1000,
      processorMs: (onProcessor(task) - inspectorTime) / 1000,
      cause: main === undefined ? "unknown" : causes[main.name as keyof typeof causes],
    };
  });
}

/** Processor time of the longest task in milliseconds. */
export function longestTaskMsOf(events: readonly TraceEvent[]): number {
  return mainTasksOf(events).reduce((longest, { processorMs }) => Math.max(longest, processorMs), 0);
}

/** Processor time of all tasks of the pages' main threads and of their workers in milliseconds. */
export function processorMsOf(events: readonly TraceEvent[]): number {
  const threads = new Set(
    events
      .filter(
        ({ name, args }) => name === "thread_name" && /^(CrRendererMain|DedicatedWorker thread)/.test(args.name ?? ""),
      )
      .map(threadOf),
  );
  return (
    Array.from(threads, (thread) =>
      outermostTasks(events.filter((event) => event.ph === "X" && threadOf(event) === thread).toSorted(byBegin)),
    )
      .flat()
      .reduce((sum, task) => sum + onProcessor(task), 0) / 1000
  );
}

/** Orders events by begin, outer events before inner ones. */
function byBegin(a: TraceEvent, b: TraceEvent): number {
  return a.ts - b.ts || (b.dur ?? 0) - (a.dur ?? 0);
}

function endOf({ ts, dur = 0 }: TraceEvent): number {
  return ts + dur;
}

function onProcessor({ tdur = 0 }: TraceEvent): number {
  return tdur;
}

function threadOf({ pid, tid }: TraceEvent): string {
  return `${pid}/${tid}`;
}
