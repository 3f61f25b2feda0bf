// Runs jobs from one priority queue in a few slots. A job frees its slot in one `finally`, whatever becomes of it:
// X3DOM's download manager stopped after six network errors because an error kept its slot.

import type { Prioritised } from "./priorityQueue.ts";
import { PriorityQueue } from "./priorityQueue.ts";

/** `signal` tells it to stop. Its slot is free once the promise settles. */
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

  /** With fewer slots, running jobs continue; new jobs wait until a slot is free. */
  set slotCount(count: number) {
    this.#slotCount = count;
    this.#pumpSoon();
  }

  /** Number of jobs that hold a slot. */
  get running(): number {
    return this.#running;
  }

  /** Number of jobs in the queue. */
  get waiting(): number {
    return this.#queue.size;
  }

  /** Number of jobs that ever got a slot. */
  get started(): number {
    return this.#started;
  }

  /**
   * Runs `job` when a slot is free and no job of a larger priority waits; equal priorities keep their order. The
   * subject's priority is read now and after each `reorder`. Rejects with the signal's reason when aborted while
   * waiting; a running job gets the signal. No job starts before the caller's microtask has ended, so that jobs that
   * are enqueued together are ordered together.
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

  /** Call when priorities have changed. The queue reads them once, when the next slot is free. */
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
