// Work waits in one queue and runs in a few slots. A slot is given back exactly
// once, in one `finally`, whatever becomes of the job: X3DOM's download manager
// stood still after six network errors because an error kept its slot.

import type { Prioritised } from "./priorityQueue.ts";
import { PriorityQueue } from "./priorityQueue.ts";

/** Told to stop through `signal`; its slot is free when the promise settles. */
export type Job<Result> = (signal: AbortSignal) => Promise<Result>;

interface Waiting extends Prioritised {
  readonly start: () => void;
}

export class Scheduler {
  readonly #queue = new PriorityQueue<Waiting>();
  #slotCount: number;
  #running = 0;
  #started = 0;
  #pumpIsDue = false;
  #orderIsStale = false;

  constructor(slotCount: number) {
    this.#slotCount = slotCount;
  }

  get slotCount(): number {
    return this.#slotCount;
  }

  /** With fewer slots, what runs goes on; new jobs wait until there is room. */
  set slotCount(count: number) {
    this.#slotCount = count;
    this.#pumpSoon();
  }

  /** Jobs that hold a slot now. */
  get running(): number {
    return this.#running;
  }

  get waiting(): number {
    return this.#queue.size;
  }

  /** Jobs that ever got a slot. */
  get started(): number {
    return this.#started;
  }

  /**
   * Runs `job` when a slot is free and nothing of a larger priority waits; equal
   * priorities keep their order. The subject's priority is read now and after
   * each `reorder`. Rejects with the signal's reason when aborted while waiting;
   * a job that runs is told through its signal. Nothing starts before the
   * caller's turn of the event loop has ended, so that what is enqueued together
   * is ordered together.
   */
  run<Result>(subject: Prioritised, signal: AbortSignal, job: Job<Result>): Promise<Result> {
    return new Promise((resolve, reject) => {
      if (signal.aborted) {
        reject(signal.reason as Error);
        return;
      }
      const leave = () => {
        this.#queue.remove(entry);
        reject(signal.reason as Error);
      };
      const entry = this.#queue.push({
        get priority() {
          return subject.priority;
        },
        start: () => {
          signal.removeEventListener("abort", leave);
          void this.#occupySlot(job, signal).then(resolve, reject);
        },
      });
      signal.addEventListener("abort", leave, { once: true });
      this.#pumpSoon();
    });
  }

  /** Priorities have changed. They are looked at when the next slot is free, however often this is called before. */
  reorder(): void {
    this.#orderIsStale = true;
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

  #pumpSoon(): void {
    if (this.#pumpIsDue) return;
    this.#pumpIsDue = true;
    queueMicrotask(() => {
      this.#pumpIsDue = false;
      this.#pump();
    });
  }

  #pump(): void {
    while (this.#running < this.#slotCount && this.#queue.size > 0) {
      if (this.#orderIsStale) this.#queue.reorder();
      this.#orderIsStale = false;
      this.#queue.pop()?.start();
    }
  }
}
