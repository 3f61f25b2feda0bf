// Which failures another attempt may mend, and how long to wait before it.

/** What is known of a failure. */
export interface Failure {
  readonly kind: "http" | "network" | "timeout" | "limit";
  readonly status: number;
  /** The header as it came: seconds, or a date (RFC 9110, 10.2.3). */
  readonly retryAfter: string | undefined;
}

/** A server that asks for more patience than this is taken at its word: the file has failed. */
export const maxRetryAfterMs = 60_000;

/** The server is busy or in trouble (RFC 9110, 15.5.9, 15.6; RFC 6585, 4); every other answer stays what it is. */
function isPassing(status: number): boolean {
  return status === 408 || status === 425 || status === 429 || (status >= 500 && status !== 501 && status !== 505);
}

/** Milliseconds until the next attempt, at least `backoffMs`; undefined where it would not help. */
export function retryDelayMs(failure: Failure, backoffMs: number, nowMs: number): number | undefined {
  if (failure.kind === "limit") return undefined;
  if (failure.kind === "http" && !isPassing(failure.status)) return undefined;
  const asked = failure.retryAfter === undefined ? 0 : patienceAsked(failure.retryAfter, nowMs);
  return asked > maxRetryAfterMs ? undefined : Math.max(backoffMs, asked);
}

function patienceAsked(retryAfter: string, nowMs: number): number {
  const text = retryAfter.trim();
  if (/^\d+$/.test(text)) return Number(text) * 1000;
  const date = Date.parse(text);
  return Number.isNaN(date) ? 0 : date - nowMs;
}
