// The rate of the line, as the page's files have measured it.

/**
 * Below this rate, patches take longer to arrive than TypeScript takes to decode them, and the WebAssembly decoder
 * would delay them: docs/decisions/wasm.md.
 */
const minBitsPerSecond = 8e6;

/** Shorter transfers are over in one or two round trips, whatever the rate. */
const minMeasuredBytes = 10_000;

/**
 * The largest rate of a file, or of files that have arrived at the same time, since they share the line; undefined if
 * all came from the cache or were small.
 */
export function measuredBitsPerSecond(resources: readonly PerformanceResourceTiming[]): number | undefined {
  const files = resources
    .filter(({ transferSize, encodedBodySize }) => transferSize > 0 && encodedBodySize >= minMeasuredBytes)
    .map(({ encodedBodySize: bytes, responseStart: begin, responseEnd: end }) => ({ bytes, begin, end }))
    .filter(({ begin, end }) => begin <= end); // the script of a worker may have wrong times
  const rates = [...files, ...joined(files)].map(({ bytes, begin, end }) => (8000 * bytes) / Math.max(1, end - begin));
  return rates.length > 0 ? Math.max(...rates) : undefined;
}

/** A transfer; times in milliseconds. */
interface Arrival {
  readonly bytes: number;
  readonly begin: number;
  readonly end: number;
}

/** Transfers that overlap are joined to one. */
function joined(arrivals: readonly Arrival[]): readonly Arrival[] {
  const all: Arrival[] = [];
  for (const arrival of arrivals.toSorted((a, b) => a.begin - b.begin)) {
    const last = all.at(-1);
    if (last === undefined || arrival.begin >= last.end) all.push(arrival);
    else {
      const { bytes, begin, end } = last;
      all[all.length - 1] = { bytes: bytes + arrival.bytes, begin, end: Math.max(end, arrival.end) };
    }
  }
  return all;
}

/** As this page's files have measured it so far. */
export function lineBitsPerSecond(): number | undefined {
  return measuredBitsPerSecond(performance.getEntriesByType("resource") as PerformanceResourceTiming[]);
}

/** Whether files take longer to arrive than to be decoded; false while nothing is known of the line. */
export function isLineSlow(): boolean {
  return (lineBitsPerSecond() ?? Infinity) < minBitsPerSecond;
}
