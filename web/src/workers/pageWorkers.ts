// The worker pool of a page. The worker's file stands beside the runtime's.

import { WorkerPool } from "./workerPool.ts";

interface WorkerModule {
  runJob(message: { name: string; input: unknown }): Promise<unknown>;
}

const idleMs = 10_000;

// `imgeo convert` puts the name that the file has in the site in the place of this
// one; bundlers that know this form bring the file along.
const besideThis = (): URL => new URL("./imgeo-worker.js", import.meta.url);

export function pageWorkers(url: string | URL = besideThis()): WorkerPool {
  let module: Promise<WorkerModule> | undefined;
  const load = () =>
    module ??= import(/* webpackIgnore: true */ /* @vite-ignore */ new URL(url, document.baseURI).href) as Promise<WorkerModule>;
  return new WorkerPool({
    // One core is the page's; but while it waits, two workers share what there is.
    size: Math.min(4, Math.max(2, navigator.hardwareConcurrency - 1)),
    idleMs,
    start: () => new Worker(url, { type: "module", name: "imgeo" }),
    runHere: async (message) => (await load()).runJob(message),
    prepareHere: () => { load().catch(() => undefined); }, // whoever runs a job is told
  });
}
