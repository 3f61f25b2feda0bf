// Fetches the WebAssembly module of decoders for workers, where it pays.

import { workersAllowWasm } from "./wasmPolicy.ts";

/**
 * Below this rate, patches take longer to arrive than TypeScript takes to decode them, and the module would delay them:
 * docs/decisions/wasm.md.
 */
const minBitsPerSecond = 8e6;

/** Shorter transfers are over in one or two round trips, whatever the rate. */
const minMeasuredBytes = 10_000;

/**
 * The rate of the line as the page's resources have measured it: that of the fastest, since several may share the line;
 * undefined if all came from the cache or were small.
 */
export function measuredBitsPerSecond(resources: readonly PerformanceResourceTiming[]): number | undefined {
  const rates = resources
    .filter(({ transferSize, encodedBodySize }) => transferSize > 0 && encodedBodySize >= minMeasuredBytes)
    .map(({ encodedBodySize, responseStart, responseEnd }) => (8000 * encodedBodySize) / (responseEnd - responseStart));
  return rates.length > 0 ? Math.max(...rates) : undefined;
}

/**
 * The bytes of the module; undefined if the workers may not compile it, if the line is slow, or if it cannot be
 * fetched. Never rejects.
 */
export async function fetchDecoder(workerUrl: URL, moduleUrl: URL): Promise<ArrayBuffer | undefined> {
  if (typeof WebAssembly === "undefined") return undefined;
  const rate = measuredBitsPerSecond(performance.getEntriesByType("resource") as PerformanceResourceTiming[]);
  if (rate !== undefined && rate < minBitsPerSecond) return undefined;
  try {
    if (!(await workersAllowWasm(workerUrl))) return undefined;
    const response = await fetch(moduleUrl, { priority: "low" });
    return response.ok ? await response.arrayBuffer() : undefined;
  } catch {
    return undefined;
  }
}
