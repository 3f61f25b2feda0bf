// Decides which failed requests are tried again, and after how long.

/** A failed request. */
export interface Failure {
  readonly kind: "http" | "network" | "timeout" | "limit";
  readonly status: number;
  /** The Retry-After header: seconds, or a date (RFC 9110, 10.2.3). */
  readonly retryAfter: string | undefined;
}

/** The longest Retry-After that is respected; a longer one is a permanent failure. */
export const maxRetryAfterMs = 60_000;

/**
 * Whether the status is temporary: the server is busy or has an internal error (RFC 9110, 15.5.9, 15.6; RFC 6585, 4).
 */
function isTemporary(status: number): boolean {
  return status === 408 || status === 425 || status === 429 || (status >= 500 && status !== 501 && status !== 505);
}

/** Milliseconds until the next attempt, at least `backoffMs`; undefined where the request is not tried again. */
export function retryDelayMs(failure: Failure, backoffMs: number, nowMs: number): number | undefined {
  if (failure.kind === "limit") return undefined;
  if (failure.kind === "http" && !isTemporary(failure.status)) return undefined;
  const requestedMs = failure.retryAfter === undefined ? 0 : requestedDelayMs(failure.retryAfter, nowMs);
  return requestedMs > maxRetryAfterMs ? undefined : Math.max(backoffMs, requestedMs);
}

function requestedDelayMs(retryAfter: string, nowMs: number): number {
  const text = retryAfter.trim();
  if (/^\d+$/.test(text)) return Number(text) * 1000;
  const date = Date.parse(text);
  return Number.isNaN(date) ? 0 : date - nowMs;
}
