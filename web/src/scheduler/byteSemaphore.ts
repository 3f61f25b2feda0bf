// What has come and is not on the GPU yet. When downloads are faster than
// decoding and upload, downloads wait, so that memory stays small.

import type { Prioritised } from "./priorityQueue.ts";
import { PriorityQueue } from "./priorityQueue.ts";

interface Waiting extends Prioritised {
  readonly bytes: number;
  readonly enter: () => void;
}

/** Gives the room back; a second call does nothing. */
export type Release = () => void;

export class ByteSemaphore {
  readonly #mostBytes: number;
  readonly #queue = new PriorityQueue<Waiting>();
  #bytes = 0;

  constructor(mostBytes: number) {
    this.#mostBytes = mostBytes;
  }

  /** Bytes that are inside now. */
  get bytes(): number {
    return this.#bytes;
  }

  /**
   * Resolves when there is room for so many bytes, in the order of asking; what
   * is larger than all the room enters alone. Rejects with the signal's reason
   * when aborted while waiting.
   */
  acquire(bytes: number, signal: AbortSignal): Promise<Release> {
    return new Promise((resolve, reject) => {
      if (signal.aborted) {
        reject(signal.reason as Error);
        return;
      }
      const give = () => {
        this.#queue.remove(entry);
        reject(signal.reason as Error);
        this.#admit(); // a smaller one behind it may fit
      };
      const entry = this.#queue.push({
        priority: 0,
        bytes,
        enter: () => {
          signal.removeEventListener("abort", give);
          this.#bytes += bytes;
          resolve(this.#leaveOnce(bytes));
        },
      });
      signal.addEventListener("abort", give, { once: true });
      this.#admit();
    });
  }

  #leaveOnce(bytes: number): Release {
    let isInside = true;
    return () => {
      if (!isInside) return;
      isInside = false;
      this.#bytes -= bytes;
      this.#admit();
    };
  }

  #admit(): void {
    for (;;) {
      const next = this.#queue.first;
      if (next === undefined || (this.#bytes > 0 && this.#bytes + next.bytes > this.#mostBytes)) return;
      this.#queue.pop();
      next.enter();
    }
  }
}
