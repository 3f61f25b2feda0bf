// Runs jobs from one priority queue in a limited number of slots, and starts no download while those that run have
// enough to receive. A job frees its slot whether it succeeds or fails: X3DOM's download manager stopped after six
// network errors because an error kept its slot.

import type { Prioritized } from "./priorityQueue.ts";
import { PriorityQueue } from "./priorityQueue.ts";
import { TransferWindow } from "./transferWindow.ts";

/** A job stops when `signal` aborts. Its slot becomes free when the promise settles. */
export type Job<Result> = (signal: AbortSignal) => Promise<Result>;

/** What a job loads. */
export interface JobSubject extends Prioritized {
  /** Bytes that the job has still to receive, as far as known; absent: too few to count. */
  readonly remainingBytes?: number;
}

/** A job that has received nothing for this long does not keep others from starting. */
const stallMs = 500;

interface WaitingJob extends Prioritized {
  readonly start: () => void;
}

export class Scheduler {
  /** How many bytes running downloads may have to receive when another one starts. */
  readonly window = new TransferWindow();
  readonly #queue = new PriorityQueue<WaitingJob>();
  /** The subjects of running jobs, each with the time at which it has last received bytes. */
  readonly #running = new Map<JobSubject, number>();
  #slotCount: number;
  #runningCount = 0;
  #startedCount = 0;
  #pumpIsDue = false;
  #orderIsStale = false;
  #stallTimer: ReturnType<typeof setTimeout> | undefined;

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
   * Runs `job` when a slot is free, the transfer window allows it, and no job of a larger priority waits; equal
   * priorities keep their order. The subject's priority is read now and after each `reorder`. Rejects with the signal's reason when aborted while
   * waiting; a running job gets the signal. No job starts before the caller's microtask has ended, so that jobs that
   * are enqueued together are ordered together.
   */
  run<Result>(subject: JobSubject, signal: AbortSignal, job: Job<Result>): Promise<Result> {
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
          void this.#occupySlot(subject, job, signal).then(resolve, reject);
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

  /** Call when a running job has received bytes: the window may allow another job. */
  onBytes(subject: JobSubject): void {
    if (this.#running.has(subject)) this.#running.set(subject, performance.now());
    if (this.#queue.size > 0) this.#pumpSoon();
  }

  async #occupySlot<Result>(subject: JobSubject, job: Job<Result>, signal: AbortSignal): Promise<Result> {
    this.#running.set(subject, performance.now());
    this.#runningCount += 1;
    this.#startedCount += 1;
    try {
      return await job(signal); // a synchronous throw of `job` is caught here like a rejection
    } finally {
      this.#running.delete(subject);
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
    while (this.#queue.size > 0 && this.#mayStart()) {
      if (this.#orderIsStale) this.#queue.reorder();
      this.#orderIsStale = false;
      this.#queue.pop()?.start();
    }
  }

  #mayStart(): boolean {
    if (this.#runningCount >= this.#slotCount) return false;
    const now = performance.now();
    let remainingBytes = 0;
    let stallsAt = Infinity;
    for (const [subject, receivedAt] of this.#running) {
      if (subject.remainingBytes === undefined || receivedAt + stallMs <= now) continue;
      remainingBytes += subject.remainingBytes;
      stallsAt = Math.min(stallsAt, receivedAt + stallMs);
    }
    if (remainingBytes <= this.window.byteLength) return true;
    clearTimeout(this.#stallTimer);
    this.#stallTimer = setTimeout(() => {
      this.#pump();
    }, stallsAt - now);
    return false;
  }
}
