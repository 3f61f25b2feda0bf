// Work that may not hold up a frame: done in small steps, so many bytes and so
// many milliseconds before each one. Bursts are what freezes a page while a
// scene arrives, not the work as a whole.

export interface FrameTaskQueueOptions {
  /** At least one step is taken before each frame, and none that begins beyond these. */
  readonly bytesPerFrame: number;
  readonly millisecondsPerFrame: number;
  readonly now: () => number;
  /** Calls back before the next frame; or soon, and with `true`, where nobody sees any: the work is then done at once. */
  readonly requestFrame: (callback: (isUnseen?: boolean) => void) => void;
}

/** Each turn takes a step and yields the bytes that it has moved. */
export type Steps = Iterator<number, void, void>;

interface Work {
  readonly steps: Steps;
  readonly signal: AbortSignal;
  readonly resolve: () => void;
  readonly reject: (reason: Error) => void;
}

export class FrameTaskQueue {
  readonly #options: FrameTaskQueueOptions;
  /** In order of arrival, which is that of the requests: what matters most came first. */
  readonly #queue: Work[] = [];
  #frameIsDue = false;

  constructor(options: FrameTaskQueueOptions) {
    this.#options = options;
  }

  /**
   * Takes all steps, in this frame or the next ones. Rejects with what a step
   * throws, or with the signal's reason, after which none is taken.
   */
  run(steps: Steps, signal: AbortSignal): Promise<void> {
    return new Promise((resolve, reject) => {
      this.#queue.push({ steps, signal, resolve, reject });
      this.#frameSoon();
    });
  }

  #frameSoon(): void {
    if (this.#frameIsDue) return;
    this.#frameIsDue = true;
    this.#options.requestFrame((isUnseen = false) => {
      this.#frameIsDue = false;
      this.#workBeforeFrame(
        isUnseen ? Infinity : this.#options.bytesPerFrame,
        isUnseen ? Infinity : this.#options.millisecondsPerFrame,
      );
      if (this.#queue.length > 0) this.#frameSoon();
    });
  }

  #workBeforeFrame(mostBytes: number, milliseconds: number): void {
    const { now } = this.#options;
    const end = now() + milliseconds;
    let bytes = 0;
    do {
      const work = this.#queue[0];
      if (work === undefined) return;
      const moved = step(work);
      if (moved === undefined) this.#queue.shift();
      bytes += moved ?? 0;
    } while (bytes < mostBytes && now() < end);
  }
}

/** The bytes that one step has moved; undefined when there are no more. */
function step({ steps, signal, resolve, reject }: Work): number | undefined {
  try {
    signal.throwIfAborted();
    const { done, value } = steps.next();
    if (done !== true) return value;
    resolve();
  } catch (error) {
    reject(error as Error);
  }
  return undefined;
}
