// A few workers that do jobs, one at a time each. They are started when there is
// work and ended when there has been none for a while. Where workers cannot be
// started (a runtime from another origin, a policy against them) the jobs are
// done in the page.

import type { InputOf, JobName, OutputOf } from "../decode/jobs.ts";
import type { AnswerMessage, JobMessage } from "./protocol.ts";
import { asError } from "./protocol.ts";

/** The part of a Worker that is used. */
export interface JobWorker {
  onmessage: ((event: MessageEvent<AnswerMessage>) => void) | null;
  onerror: ((event: ErrorEvent) => void) | null;
  postMessage(message: JobMessage): void;
  terminate(): void;
}

export interface WorkerPoolOptions {
  readonly size: number;
  /** May throw. */
  readonly start: () => JobWorker;
  readonly runOnMainThread: (message: JobMessage) => Promise<unknown>;
  /** Fetches what `runHere` needs, ahead of whatever else is asked for. */
  readonly prepareMainThread: () => void;
  /** A worker without work ends after so long. */
  readonly idleMs: number;
}

interface Job {
  readonly message: JobMessage;
  readonly signal: AbortSignal;
  readonly resolve: (output: unknown) => void;
  readonly reject: (reason: Error) => void;
}

interface PoolWorker {
  readonly worker: JobWorker;
  job: Job | undefined;
  idleTimer: ReturnType<typeof setTimeout> | undefined;
}

export class WorkerPool {
  readonly #options: WorkerPoolOptions;
  readonly #workers = new Set<PoolWorker>();
  #waiting: Job[] = [];
  #canStart = true;
  #isDisposed = false;
  #here: Promise<void> = Promise.resolve();

  constructor(options: WorkerPoolOptions) {
    this.#options = options;
  }

  /** Workers that are alive. */
  get workerCount(): number {
    return this.#workers.size;
  }

  /** See RunJob. */
  run<Name extends JobName>(name: Name, input: InputOf<Name>, signal: AbortSignal): Promise<OutputOf<Name>> {
    return new Promise<unknown>((resolve, reject) => {
      if (signal.aborted) {
        reject(signal.reason as Error);
        return;
      }
      const job: Job = { message: { name, input }, signal, resolve, reject };
      signal.addEventListener(
        "abort",
        () => {
          this.#waiting = this.#waiting.filter((other) => other !== job);
          reject(signal.reason as Error); // one that runs is finished, and its result dropped
        },
        { once: true },
      );
      this.#waiting.push(job);
      this.#pump();
    }) as Promise<OutputOf<Name>>;
  }

  /** Starts workers for as many jobs as are to come, while their input is still on its way. */
  prepare(jobCount: number): void {
    while (this.#workers.size < Math.min(jobCount, this.#options.size) && this.#canStart && !this.#isDisposed) {
      const idle = this.#tryStart();
      if (idle !== undefined) this.#rest(idle);
    }
  }

  /** There will be jobs for `runHere`. */
  prepareMainThread(): void {
    this.#options.prepareMainThread();
  }

  /** The same at once, and here, with what a worker would do it with. */
  async runOnMainThread<Name extends JobName>(
    name: Name,
    input: InputOf<Name>,
    signal: AbortSignal,
  ): Promise<OutputOf<Name>> {
    signal.throwIfAborted();
    const output = await this.#options.runOnMainThread({ name, input });
    signal.throwIfAborted();
    return output as OutputOf<Name>;
  }

  /** Ends the workers; jobs that are not done never are. */
  dispose(): void {
    this.#isDisposed = true;
    this.#waiting = [];
    for (const busy of this.#workers) this.#end(busy);
  }

  #pump(): void {
    while (this.#waiting.length > 0 && !this.#isDisposed) {
      const idle = this.#idle();
      if (idle === "none") return;
      const job = this.#waiting.shift();
      if (job === undefined) return;
      if (idle === "never") {
        this.#doHere(job);
        continue;
      }
      clearTimeout(idle.idleTimer);
      idle.job = job;
      idle.worker.postMessage(job.message);
    }
  }

  /** A worker without a job; "none" while all are at work, "never" where none can be started. */
  #idle(): PoolWorker | "none" | "never" {
    const idle = Array.from(this.#workers).find(({ job }) => job === undefined);
    if (idle !== undefined) return idle;
    if (!this.#canStart) return "never";
    if (this.#workers.size >= this.#options.size) return "none";
    return this.#tryStart() ?? "never";
  }

  #tryStart(): PoolWorker | undefined {
    try {
      return this.#start(this.#options.start());
    } catch {
      this.#canStart = false;
      return undefined;
    }
  }

  /** Until there is a job, or for good. */
  #rest(busy: PoolWorker): void {
    busy.idleTimer = setTimeout(() => {
      this.#end(busy);
    }, this.#options.idleMs);
  }

  #start(worker: JobWorker): PoolWorker {
    const busy: PoolWorker = { worker, job: undefined, idleTimer: undefined };
    this.#workers.add(busy);
    worker.onmessage = ({ data }) => {
      this.#take(busy, data);
    };
    worker.onerror = (event) => {
      // Its module did not load: jobs catch their own errors.
      event.preventDefault();
      this.#canStart = false;
      const { job } = busy;
      this.#end(busy);
      if (job) this.#waiting.unshift(job);
      this.#pump();
    };
    return busy;
  }

  #take(busy: PoolWorker, answer: AnswerMessage): void {
    const { job } = busy;
    busy.job = undefined;
    if ("output" in answer) job?.resolve(answer.output);
    else job?.reject(asError(answer));
    this.#rest(busy);
    this.#pump();
  }

  #end(busy: PoolWorker): void {
    clearTimeout(busy.idleTimer);
    busy.worker.terminate();
    this.#workers.delete(busy);
  }

  /** One after the other, with room for the page in between. */
  #doHere({ message, signal, resolve, reject }: Job): void {
    this.#here = this.#here.then(async () => {
      await new Promise((next) => {
        setTimeout(next);
      });
      if (!signal.aborted && !this.#isDisposed) await this.#options.runOnMainThread(message).then(resolve, reject);
    });
  }
}
