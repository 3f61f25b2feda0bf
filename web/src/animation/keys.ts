// The keys of interpolators and sequencers (ISO/IEC 19775-1, 19.2.2): ascending numbers, equal ones allowed.

/** Between which keys a fraction lies: f = (1 - weight) * value[from] + weight * value[to]. */
export interface KeySpan {
  readonly from: number;
  readonly to: number;
  /** 0 … 1. */
  readonly weight: number;
}

export function isAscending(keys: readonly number[]): boolean {
  return keys.every((key, i) => i === 0 || key >= (keys[i - 1] ?? key));
}

/** The index of the last of the first `count` keys that is at most `fraction`; -1 where there is none. */
export function lastKeyUpTo(keys: readonly number[], count: number, fraction: number): number {
  let low = 0;
  let high = count;
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((keys[middle] ?? Infinity) <= fraction) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

/** The span of the first `count` keys, at least one, that a fraction lies in. At equal keys the last one counts. */
export function keySpanOf(keys: readonly number[], count: number, fraction: number): KeySpan {
  const from = lastKeyUpTo(keys, count, fraction);
  if (from < 0) return { from: 0, to: 0, weight: 0 };
  if (from >= count - 1) return { from: count - 1, to: count - 1, weight: 0 };
  const begin = keys[from] ?? 0;
  const length = (keys[from + 1] ?? begin) - begin;
  return { from, to: from + 1, weight: (fraction - begin) / length };
}
