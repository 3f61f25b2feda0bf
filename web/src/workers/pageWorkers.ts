// The worker pool of a page. The worker's file stands beside the runtime's.

import { WorkerPool } from "./workerPool.ts";

interface WorkerModule {
  runJob(message: { name: string; input: unknown }): Promise<unknown>;
}

const idleMs = 10_000;

export function pageWorkers(): WorkerPool {
  // `imgeo convert` puts the name that the file has in the site in the place of this one.
  const url = new URL("./imgeo-worker.js", import.meta.url);
  return new WorkerPool({
    // One core is the page's.
    size: Math.min(4, Math.max(1, navigator.hardwareConcurrency - 1)),
    idleMs,
    start: () => new Worker(url, { type: "module", name: "imgeo" }),
    runHere: async (message) => ((await import(url.href)) as WorkerModule).runJob(message),
  });
}
