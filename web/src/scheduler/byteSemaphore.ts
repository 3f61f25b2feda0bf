// A semaphore that counts bytes: limits the downloaded bytes that wait for decoding and upload. When downloads are
// faster than both, further downloads wait, so that memory use stays small.

import type { Prioritized } from "./priorityQueue.ts";
import { PriorityQueue } from "./priorityQueue.ts";

interface WaitingRequest extends Prioritized {
  readonly bytes: number;
  readonly admit: () => void;
}

/** Frees the bytes; a second call does nothing. */
export type Release = () => void;

export class ByteSemaphore {
  readonly #maxBytes: number;
  readonly #queue = new PriorityQueue<WaitingRequest>();
  #bytes = 0;

  constructor(maxBytes: number) {
    this.#maxBytes = maxBytes;
  }

  /** Bytes that are acquired now. */
  get bytes(): number {
    return this.#bytes;
  }

  /**
   * Resolves when there is room for the bytes, in the order of calls; a request larger than the limit is admitted
   * alone. Rejects with the signal's reason when aborted while waiting.
   */
  acquire(bytes: number, signal: AbortSignal): Promise<Release> {
    return new Promise((resolve, reject) => {
      if (signal.aborted) {
        reject(signal.reason as Error);
        return;
      }
      const cancel = () => {
        this.#queue.remove(entry);
        reject(signal.reason as Error);
        this.#admit(); // a smaller request behind it may fit
      };
      const entry = this.#queue.push({
        priority: 0,
        bytes,
        admit: () => {
          signal.removeEventListener("abort", cancel);
          this.#bytes += bytes;
          resolve(this.#releaseOnce(bytes));
        },
      });
      signal.addEventListener("abort", cancel, { once: true });
      this.#admit();
    });
  }

  #releaseOnce(bytes: number): Release {
    let isAcquired = true;
    return () => {
      if (!isAcquired) return;
      isAcquired = false;
      this.#bytes -= bytes;
      this.#admit();
    };
  }

  #admit(): void {
    for (;;) {
      const next = this.#queue.first;
      if (next === undefined || (this.#bytes > 0 && this.#bytes + next.bytes > this.#maxBytes)) return;
      this.#queue.pop();
      next.admit();
    }
  }
}
