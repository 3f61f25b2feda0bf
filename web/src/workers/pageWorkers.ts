// The worker pool of a page. The worker's file stands beside the runtime's.

import { DecodeError } from "../decode/decodeError.ts";
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
    (module ??= importedFrom(new URL(url, document.baseURI).href).catch((error: unknown) => {
      module = undefined; // who asks next tries again
      throw error;
    }));
  return new WorkerPool({
    // One core is the page's; but while it waits, two workers share what there is.
    size: Math.min(4, Math.max(2, navigator.hardwareConcurrency - 1)),
    idleMs,
    start: () => new Worker(url, { type: "module", name: "imgeo" }),
    runOnMainThread: async (message) => (await load()).runJob(message),
    prepareMainThread: () => {
      load().catch(() => undefined);
    }, // whoever runs a job is told
  });
}

/** Rejects with DecodeError, in words for those who look for the file. */
async function importedFrom(url: string): Promise<WorkerModule> {
  try {
    return (await import(/* webpackIgnore: true */ /* @vite-ignore */ url)) as WorkerModule;
  } catch (cause) {
    throw new DecodeError(
      "unsupported",
      `needs the module of our workers, which cannot be loaded from ${url} (apps of three.js say where it is by setWorkerUrl)`,
      { cause },
    );
  }
}
