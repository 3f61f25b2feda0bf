// Runs jobs from one priority queue in a limited number of slots. A job frees its slot whether it succeeds or fails:
// X3DOM's download manager stopped after six network errors because an error kept its slot.

import type { Prioritized } from "./priorityQueue.ts";
import { PriorityQueue } from "./priorityQueue.ts";

/** A job stops when `signal` aborts. Its slot becomes free when the promise settles. */
export type Job<Result> = (signal: AbortSignal) => Promise<Result>;

interface WaitingJob extends Prioritized {
  readonly start: () => void;
}

export class Scheduler {
  readonly #queue = new PriorityQueue<WaitingJob>();
  #slotCount: number;
  #runningCount = 0;
  #startedCount = 0;
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
  get runningCount(): number {
    return this.#runningCount;
  }

  /** Number of jobs in the queue. */
  get waitingCount(): number {
    return this.#queue.size;
  }

  /** Number of jobs that ever got a slot. */
  get startedCount(): number {
    return this.#startedCount;
  }

  /**
   * Runs `job` when a slot is free and no job of a larger priority waits; equal priorities keep their order. The
   * subject's priority is read now and after each `reorder`. Rejects with the signal's reason when aborted while
   * waiting; a running job gets the signal. No job starts before the caller's microtask has ended, so that jobs that
   * are enqueued together are ordered together.
   */
  run<Result>(subject: Prioritized, signal: AbortSignal, job: Job<Result>): Promise<Result> {
    return new Promise((resolve, reject) => {
      if (signal.aborted) {
        reject(signal.reason as Error);
        return;
      }
      const cancel = () => {
        this.#queue.remove(entry);
        reject(signal.reason as Error);
      };
      const entry = this.#queue.push({
        get priority() {
          return subject.priority;
        },
        start: () => {
          signal.removeEventListener("abort", cancel);
          void this.#occupySlot(job, signal).then(resolve, reject);
        },
      });
      signal.addEventListener("abort", cancel, { once: true });
      this.#pumpSoon();
    });
  }

  /** Call when priorities have changed. The queue reads them once, when the next slot is free. */
  reorder(): void {
    this.#orderIsStale = true;
  }

  async #occupySlot<Result>(job: Job<Result>, signal: AbortSignal): Promise<Result> {
    this.#runningCount += 1;
    this.#startedCount += 1;
    try {
      return await job(signal); // a synchronous throw of `job` is caught here like a rejection
    } finally {
      this.#runningCount -= 1;
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
    while (this.#runningCount < this.#slotCount && this.#queue.size > 0) {
      if (this.#orderIsStale) this.#queue.reorder();
      this.#orderIsStale = false;
      this.#queue.pop()?.start();
    }
  }
}
