// Fetches the WebAssembly module of decoders, in the worker that compiles it: the page's thread is busy while a scene
// begins to load.

import { workersAllowWasm } from "./wasmPolicy.ts";

/**
 * The module, compiled; undefined if a worker with the file at `workerUrl` may not compile it, or if it cannot be
 * fetched or compiled. Never rejects.
 */
export async function fetchDecoder(workerUrl: URL, moduleUrl: URL): Promise<WebAssembly.Module | undefined> {
  if (typeof WebAssembly === "undefined") return undefined;
  try {
    // The page has requested it, too, and so have other workers: usually it comes from the browser's cache.
    const [isAllowed, response] = await Promise.all([
      workersAllowWasm(workerUrl),
      fetch(moduleUrl, { priority: "low", cache: "force-cache" }),
    ]);
    return isAllowed && response.ok ? await WebAssembly.compile(await response.arrayBuffer()) : undefined;
  } catch {
    return undefined;
  }
}
