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
    if (!(await workersAllowWasm(workerUrl))) return undefined;
    // Several workers fetch it: those after the first take it from the browser's cache.
    const response = await fetch(moduleUrl, { priority: "low", cache: "force-cache" });
    return response.ok ? await WebAssembly.compile(await response.arrayBuffer()) : undefined;
  } catch {
    return undefined;
  }
}
