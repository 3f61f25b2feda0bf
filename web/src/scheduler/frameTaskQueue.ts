// Runs long work in small steps before frames, within limits of bytes and milliseconds, so that no frame is late while
// a scene loads.

/**
 * Limit of what the element, or a scene in a three.js app, uploads to the GPU before a frame: 240 MiB a second at 60
 * Hz.
 */
export const uploadBytesPerFrame = 4 * 2 ** 20;

export interface FrameTaskQueueOptions {
  /** Before each frame at least one step runs, and none begins once a limit is reached. */
  readonly bytesPerFrame: number;
  readonly millisecondsPerFrame: number;
  readonly now: () => number;
  /**
   * Calls back before the next frame; or soon, and with `true`, where the page is hidden: all work then runs at once.
   */
  readonly requestFrame: (callback: (isHidden?: boolean) => void) => void;
}

/** Each call of `next` runs one step and yields the bytes that it moved. */
export type Steps = Iterator<number, void, void>;

interface Task {
  readonly steps: Steps;
  readonly signal: AbortSignal;
  readonly resolve: () => void;
  readonly reject: (reason: Error) => void;
}

export class FrameTaskQueue {
  readonly #options: FrameTaskQueueOptions;
  /** First in, first out. Files are requested by priority, so that the most important ones mostly come first. */
  readonly #queue: Task[] = [];
  #frameIsDue = false;

  constructor(options: FrameTaskQueueOptions) {
    this.#options = options;
  }

  /**
   * Runs all steps, before the next frame or later ones. Rejects with what a step throws, or with the signal's reason;
   * no step runs after that.
   */
  run(steps: Steps, signal: AbortSignal): Promise<void> {
    return new Promise((resolve, reject) => {
      this.#queue.push({ steps, signal, resolve, reject });
      this.#requestFrame();
    });
  }

  #requestFrame(): void {
    if (this.#frameIsDue) return;
    this.#frameIsDue = true;
    this.#options.requestFrame((isHidden = false) => {
      this.#frameIsDue = false;
      this.#workBeforeFrame(
        isHidden ? Infinity : this.#options.bytesPerFrame,
        isHidden ? Infinity : this.#options.millisecondsPerFrame,
      );
      if (this.#queue.length > 0) this.#requestFrame();
    });
  }

  #workBeforeFrame(maxBytes: number, milliseconds: number): void {
    const { now } = this.#options;
    const end = now() + milliseconds;
    let bytes = 0;
    do {
      const task = this.#queue[0];
      if (task === undefined) return;
      const moved = step(task);
      if (moved === undefined) this.#queue.shift();
      bytes += moved ?? 0;
    } while (bytes < maxBytes && now() < end);
  }
}

/** The bytes that one step moved; undefined when there are no more steps. */
function step({ steps, signal, resolve, reject }: Task): number | undefined {
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
