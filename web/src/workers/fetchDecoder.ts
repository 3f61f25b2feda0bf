// Fetches the WebAssembly module of decoders, in the worker that compiles it: the page's thread is busy while a scene
// begins to load.

import { fetchFile } from "./fetchFile.ts";
import { workersAllowWasm } from "../policy/wasmPolicy.ts";

/** Maximum size of the module, a hundred times that of today's. */
export const maxModuleBytes = 2 ** 23;

/**
 * The module, compiled; undefined if a worker with the file at `workerUrl` may not compile it, or if it cannot be
 * fetched or compiled. Never rejects.
 */
export async function fetchDecoder(workerUrl: URL, moduleUrl: URL): Promise<WebAssembly.Module | undefined> {
  if (typeof WebAssembly === "undefined") return undefined;
  try {
    // The page has requested it, too, and so have other workers: usually it comes from the browser's cache.
    const [isAllowed, bytes] = await Promise.all([
      workersAllowWasm(workerUrl),
      fetchFile(moduleUrl.href, { priority: "low", maxBytes: maxModuleBytes }),
    ]);
    return isAllowed ? await WebAssembly.compile(bytes) : undefined;
  } catch {
    return undefined;
  }
}
