// Tests how the benchmarks read tasks and processor times from Chromium's traces.

import assert from "node:assert/strict";
import { test } from "node:test";
import { longestTaskMsOf, mainTasksOf, processorMsOf, type TraceEvent } from "../bench/load/trace.ts";

/** A trace event; times in milliseconds. */
function event(tid: number, name: string, at: number, ms: number, processorMs: number): TraceEvent {
  return { name, ph: "X", pid: 1, tid, ts: 1000 * at, dur: 1000 * ms, tdur: 1000 * processorMs, args: {} };
}

const threads: TraceEvent[] = ["CrRendererMain", "DedicatedWorker thread", "Compositor"].map((name, tid) => ({
  name: "thread_name",
  ph: "M",
  pid: 1,
  tid,
  ts: 0,
  args: { name },
}));

const events = [
  ...threads,
  event(0, "ThreadControllerImpl::RunTask", 10, 100, 60),
  event(0, "SimpleTask::RunTask", 10, 99, 59),
  event(0, "v8.evaluateModule", 20, 80, 50),
  event(0, "FunctionCall", 30, 60, 40),
  event(0, "V8.CollectSourcePositions", 40, 20, 15),
  event(0, "ThreadControllerImpl::RunTask", 120, 30, 9),
  event(0, "FireAnimationFrame", 121, 20, 8),
  event(0, "ThreadControllerImpl::RunTask", 160, 5, 1),
  event(1, "ThreadControllerImpl::RunTask", 15, 200, 100),
  event(2, "ThreadControllerImpl::RunTask", 15, 300, 300),
];

test("tasks of the main thread have durations and main causes", () => {
  assert.deepEqual(mainTasksOf(events), [
    { ms: 100, processorMs: 45, cause: "start of the module" },
    { ms: 30, processorMs: 9, cause: "a frame" },
    { ms: 5, processorMs: 1, cause: "unknown" },
  ]);
  assert.deepEqual(
    mainTasksOf(events, 120_000).map(({ ms }) => ms),
    [30, 5],
  );
});

test("processor times of the page and its workers are added, each task once", () => {
  assert.equal(processorMsOf(events), 60 + 9 + 1 + 100);
});

test("a trace of thirty thousand tasks is read in linear time", () => {
  const many = Array.from({ length: 30_000 }, (_, n) => [
    event(0, "ThreadControllerImpl::RunTask", n, 0.9, 0.5),
    event(0, "TimerFire", n + 0.1, 0.5, 0.4),
  ]).flat();
  const tasks = mainTasksOf([
    ...threads,
    ...many,
    event(0, "ThreadControllerImpl::RunTask", 30_000, 9, 7),
    event(0, "FunctionCall", 30_001, 5, 5),
  ]);
  assert.equal(tasks.length, 30_001);
  assert.ok(tasks.slice(0, -1).every(({ processorMs, cause }) => processorMs === 0.5 && cause === "a timer"));
  assert.deepEqual(tasks.at(-1), { ms: 9, processorMs: 7, cause: "a callback" });
  assert.equal(longestTaskMsOf([...threads, ...many]), 0.5);
});
