/** Delays a call that may be requested often, so that it runs once in an interval. */
export class Throttle {
  readonly #intervalMs: number;
  readonly #call: () => void;
  #timer: ReturnType<typeof setTimeout> | undefined;

  constructor(intervalMs: number, call: () => void) {
    this.#intervalMs = intervalMs;
    this.#call = call;
  }

  /** Calls within the interval, unless that has been requested already. */
  request(): void {
    this.#timer ??= setTimeout(() => {
      this.callNow();
    }, this.#intervalMs);
  }

  callNow(): void {
    this.cancel();
    this.#call();
  }

  cancel(): void {
    clearTimeout(this.#timer);
    this.#timer = undefined;
  }
}
