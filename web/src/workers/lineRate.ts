// The rate of the line, as the page's files have measured it.

/**
 * Below this rate, patches take longer to arrive than TypeScript takes to decode them, and the WebAssembly decoder
 * would delay them: docs/decisions/wasm.md.
 */
const minBitsPerSecond = 8e6;

/** Shorter transfers are over in one or two round trips, whatever the rate. */
const minMeasuredBytes = 10_000;

/**
 * That of the fastest file, since several may share the line; undefined if all came from the cache or were small.
 */
export function measuredBitsPerSecond(resources: readonly PerformanceResourceTiming[]): number | undefined {
  const rates = resources
    .filter(({ transferSize, encodedBodySize }) => transferSize > 0 && encodedBodySize >= minMeasuredBytes)
    .map(({ encodedBodySize, responseStart, responseEnd }) => (8000 * encodedBodySize) / (responseEnd - responseStart));
  return rates.length > 0 ? Math.max(...rates) : undefined;
}

/** As this page's files have measured it so far. */
export function lineBitsPerSecond(): number | undefined {
  return measuredBitsPerSecond(performance.getEntriesByType("resource") as PerformanceResourceTiming[]);
}

/** Whether files take longer to arrive than to be decoded; false while nothing is known of the line. */
export function isLineSlow(): boolean {
  return (lineBitsPerSecond() ?? Infinity) < minBitsPerSecond;
}
