// Work waits in one queue and runs in a few slots. A slot is given back exactly
// once, in one `finally`, whatever becomes of the job: X3DOM's download manager
// stood still after six network errors because an error kept its slot.

/** Told to stop through `signal`; its slot is free when the promise settles. */
export type Job<Result> = (signal: AbortSignal) => Promise<Result>;

interface Waiting {
  readonly priority: number;
  readonly start: () => void;
}

export class Scheduler {
  readonly slotCount: number;
  #waiting: Waiting[] = [];
  #running = 0;
  #started = 0;
  #pumpIsDue = false;

  constructor(slotCount: number) {
    this.slotCount = slotCount;
  }

  /** Jobs that hold a slot now. */
  get running(): number {
    return this.#running;
  }

  get waiting(): number {
    return this.#waiting.length;
  }

  /** Jobs that ever got a slot. */
  get started(): number {
    return this.#started;
  }

  /**
   * Runs `job` when a slot is free and nothing of a smaller priority number
   * waits; equal priorities keep their order. Rejects with the signal's reason
   * when aborted while waiting; a job that runs is told through its signal.
   * Nothing starts before the caller's turn of the event loop has ended, so that
   * what is enqueued together is ordered together.
   */
  run<Result>(priority: number, signal: AbortSignal, job: Job<Result>): Promise<Result> {
    return new Promise((resolve, reject) => {
      if (signal.aborted) {
        reject(signal.reason as Error);
        return;
      }
      const leave = () => {
        this.#waiting = this.#waiting.filter((other) => other !== entry);
        reject(signal.reason as Error);
      };
      const entry: Waiting = {
        priority,
        start: () => {
          signal.removeEventListener("abort", leave);
          void this.#occupySlot(job, signal).then(resolve, reject);
        },
      };
      signal.addEventListener("abort", leave, { once: true });
      this.#enqueue(entry);
    });
  }

  async #occupySlot<Result>(job: Job<Result>, signal: AbortSignal): Promise<Result> {
    this.#running += 1;
    this.#started += 1;
    try {
      return await job(signal); // a synchronous throw of `job` is caught here like a rejection
    } finally {
      this.#running -= 1;
      this.#pump();
    }
  }

  #enqueue(entry: Waiting): void {
    let low = 0;
    let high = this.#waiting.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if ((this.#waiting[middle]?.priority ?? Infinity) <= entry.priority) low = middle + 1;
      else high = middle;
    }
    this.#waiting.splice(low, 0, entry);
    if (this.#pumpIsDue) return;
    this.#pumpIsDue = true;
    queueMicrotask(() => {
      this.#pumpIsDue = false;
      this.#pump();
    });
  }

  #pump(): void {
    while (this.#running < this.slotCount) {
      const next = this.#waiting.shift();
      if (next === undefined) return;
      next.start();
    }
  }
}
