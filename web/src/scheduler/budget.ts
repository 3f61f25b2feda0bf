// Decides which data stay on the GPU: the most important that fit, by the priorities that also order requests. Where
// memory is short, the finest data of shapes that are small, far or out of view are evicted first, and the coarse data
// of shapes that are large in front of the camera last.

/** A request for GPU memory. */
export interface BudgetRequest {
  /** Requests of one key share their memory: a file of several patches is stored once. */
  readonly key: unknown;
  readonly bytes: number;
  /** Larger is granted first; 0: not needed now. */
  readonly priority: number;
  /** Its data are on the GPU, or on their way there. */
  readonly isAllocated: boolean;
}

/**
 * A request replaces an allocated one only where its priority is larger by this factor. While the camera stands still,
 * granted requests stay granted; while it moves, small differences do not evict and reload data.
 */
const hysteresis = 2;

interface Ranked {
  readonly request: BudgetRequest;
  /** The request before this one in its chain, without which this one is useless. */
  readonly previous: BudgetRequest | undefined;
  readonly rank: number;
}

/**
 * The requests that fit into `maxBytes` together, in order of priority. A chain holds requests in the order in which
 * they become useful: none is granted without those before it. A request that does not fit is skipped.
 */
export function grantedRequests(
  chains: Iterable<readonly BudgetRequest[]>,
  maxBytes: number,
): ReadonlySet<BudgetRequest> {
  const granted = new Set<BudgetRequest>();
  const keys = new Set<unknown>();
  let bytes = 0;
  for (const { request, previous } of ranked(chains)) {
    if (previous !== undefined && !granted.has(previous)) continue;
    const addedBytes = keys.has(request.key) ? 0 : request.bytes;
    if (bytes + addedBytes > maxBytes) continue;
    bytes += addedBytes;
    keys.add(request.key);
    granted.add(request);
  }
  return granted;
}

/** In order of rank; a request follows those before it in its chain, whatever its own priority. */
function ranked(chains: Iterable<readonly BudgetRequest[]>): Ranked[] {
  const all: Ranked[] = [];
  for (const chain of chains) {
    let priority = Infinity;
    let isAllocated = true;
    let previous: BudgetRequest | undefined;
    for (const request of chain) {
      priority = Math.min(priority, request.priority);
      isAllocated &&= request.isAllocated;
      all.push({ request, previous, rank: isAllocated ? priority * hysteresis : priority });
      previous = request;
    }
  }
  return all.sort((a, b) => b.rank - a.rank); // the sort is stable: chains keep their order
}
