// The worker pool of a page. The file of the worker is next to that of the runtime.

import { DecodeError } from "../decode/decodeError.ts";
import { startModuleWorker } from "../policy/trustedTypes.ts";
import { isLineSlow } from "./lineRate.ts";
import { withMessages } from "./protocol.ts";
import { WorkerPool } from "./workerPool.ts";

interface WorkerModule {
  runJob(message: { name: string; input: unknown }): Promise<unknown>;
}

const idleMs = 10_000;

// `imgeo convert` replaces these names by the files' names in the site; bundlers that know this pattern copy the files.
const workerUrl = (): URL => new URL("./imgeo-worker.js", import.meta.url);
const decoderUrl = (): URL => new URL("./imgeo-decoder.wasm", import.meta.url);

/** `givenUrl`: the URL of imgeo-worker.js, with imgeo-decoder.wasm beside it. */
export function pageWorkers(givenUrl?: string | URL): WorkerPool {
  const url = new URL(givenUrl ?? workerUrl(), document.baseURI);
  const decoder = givenUrl === undefined ? decoderUrl() : new URL("imgeo-decoder.wasm", url);
  let module: Promise<WorkerModule> | undefined;
  const load = () =>
    (module ??= importedFrom(url.href).catch((error: unknown) => {
      module = undefined; // the next call tries again
      throw error;
    }));
  return new WorkerPool({
    // Leaves one core to the page. There are at least two workers, since the page often waits for them.
    size: Math.min(4, Math.max(2, navigator.hardwareConcurrency - 1)),
    idleMs,
    decoderUrl: () => (isLineSlow() ? undefined : decoder.href),
    start: (messages) => startModuleWorker(withMessages(url, messages).href),
    runOnMainThread: async (message) => (await load()).runJob(message),
    prepareMainThread: () => {
      load().catch(() => undefined); // `runOnMainThread` reports the error
    },
  });
}

/** Rejects with a DecodeError that names the URL of the file. */
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
