/** Delays a call that may be requested often, so that all requests of an interval cause one call. */
export class Throttle {
  readonly #intervalMs: number;
  readonly #call: () => void;
  #timer: ReturnType<typeof setTimeout> | undefined;

  constructor(intervalMs: number, call: () => void) {
    this.#intervalMs = intervalMs;
    this.#call = call;
  }

  /** Calls after the interval, unless a call is already pending. */
  request(): void {
    this.#timer ??= setTimeout(() => {
      this.callNow();
    }, this.#intervalMs);
  }

  /** Calls now, in place of a pending call. */
  callNow(): void {
    this.cancel();
    this.#call();
  }

  /** Cancels a pending call. */
  cancel(): void {
    clearTimeout(this.#timer);
    this.#timer = undefined;
  }
}
