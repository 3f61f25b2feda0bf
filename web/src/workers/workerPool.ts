// A pool of workers that run one job each at a time. Workers are started when there are jobs, and ended when they have
// been idle for a while. Where no worker can be started (a runtime from another origin, a content security policy) jobs
// run on the main thread.

import type { InputOf, JobName, OutputOf } from "../decode/jobs.ts";
import type { AnswerMessage, DecoderMessage, JobMessage } from "./protocol.ts";
import { asError, decoderJobs } from "./protocol.ts";

/** The members of Worker that the pool uses. */
export interface JobWorker {
  onmessage: ((event: MessageEvent<AnswerMessage>) => void) | null;
  onerror: ((event: ErrorEvent) => void) | null;
  postMessage(message: JobMessage | DecoderMessage): void;
  terminate(): void;
}

export interface WorkerPoolOptions {
  readonly size: number;
  /** Starts a worker; may throw. */
  readonly start: () => JobWorker;
  readonly runOnMainThread: (message: JobMessage) => Promise<unknown>;
  /** Loads what `runOnMainThread` needs, before it is called. */
  readonly prepareMainThread: () => void;
  /**
   * The URL of the WebAssembly module that decodes compact: workers use TypeScript until they have it. Undefined where
   * it would not pay. Called once.
   */
  readonly decoderUrl: () => string | undefined;
  /** Milliseconds after which an idle worker is ended. */
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
  #mainThreadJobs: Promise<void> = Promise.resolve();
  #isDecoderRequested = false;
  #decoderUrl: string | undefined;

  constructor(options: WorkerPoolOptions) {
    this.#options = options;
  }

  /** Number of workers. */
  get workerCount(): number {
    return this.#workers.size;
  }

  /** Runs a job in a worker; see RunJob in decode/jobs.ts. */
  run<Name extends JobName>(name: Name, input: InputOf<Name>, signal: AbortSignal): Promise<OutputOf<Name>> {
    return new Promise<unknown>((resolve, reject) => {
      if (signal.aborted) {
        reject(signal.reason as Error);
        return;
      }
      const onAbort = (): void => {
        this.#waiting = this.#waiting.filter((other) => other !== job);
        reject(signal.reason as Error); // a running job finishes, and its result is ignored
      };
      signal.addEventListener("abort", onAbort, { once: true });
      // A signal may outlive thousands of jobs, as that of a live stream: it must not keep their input.
      const settled = <Value>(settle: (value: Value) => void) => {
        return (value: Value): void => {
          signal.removeEventListener("abort", onAbort);
          settle(value);
        };
      };
      const job: Job = { message: { name, input }, signal, resolve: settled(resolve), reject: settled(reject) };
      if (decoderJobs.has(name)) this.requestDecoder();
      this.#waiting.push(job);
      this.#pump();
    }) as Promise<OutputOf<Name>>;
  }

  /** Starts workers for this number of expected jobs, while their input is still loading. */
  prepare(jobCount: number): void {
    while (this.#workers.size < Math.min(jobCount, this.#options.size) && this.#canStart && !this.#isDisposed) {
      const idle = this.#tryStart();
      if (idle !== undefined) this.#endWhenIdle(idle);
    }
  }

  /** Call where files of compact have been requested; has no effect from the second time on. */
  requestDecoder(): void {
    if (this.#isDecoderRequested || !this.#canStart || this.#isDisposed) return;
    this.#isDecoderRequested = true;
    const decoderUrl = (this.#decoderUrl = this.#options.decoderUrl());
    if (decoderUrl !== undefined) for (const { worker } of this.#workers) worker.postMessage({ decoderUrl });
  }

  /** Call where jobs for `runOnMainThread` are expected. */
  prepareMainThread(): void {
    this.#options.prepareMainThread();
  }

  /** Runs a job at once on the main thread, with the code that workers run. */
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

  /** Ends the workers; the promises of unfinished jobs do not settle, unless their signals abort. */
  dispose(): void {
    this.#isDisposed = true;
    this.#waiting = [];
    for (const poolWorker of this.#workers) this.#end(poolWorker);
  }

  #pump(): void {
    while (this.#waiting.length > 0 && !this.#isDisposed) {
      const idle = this.#idleWorker();
      if (idle === "busy") return;
      const job = this.#waiting.shift();
      if (job === undefined) return;
      if (idle === "unavailable") {
        this.#runJobOnMainThread(job);
        continue;
      }
      clearTimeout(idle.idleTimer);
      idle.job = job;
      idle.worker.postMessage(job.message);
    }
  }

  /** An idle worker; "busy" while all have jobs, "unavailable" where none can be started. */
  #idleWorker(): PoolWorker | "busy" | "unavailable" {
    const idle = Array.from(this.#workers).find(({ job }) => job === undefined);
    if (idle !== undefined) return idle;
    if (!this.#canStart) return "unavailable";
    if (this.#workers.size >= this.#options.size) return "busy";
    return this.#tryStart() ?? "unavailable";
  }

  #tryStart(): PoolWorker | undefined {
    try {
      return this.#add(this.#options.start());
    } catch {
      this.#canStart = false;
      return undefined;
    }
  }

  /** Ends the worker after `idleMs`, unless it gets a job before. */
  #endWhenIdle(poolWorker: PoolWorker): void {
    poolWorker.idleTimer = setTimeout(() => {
      this.#end(poolWorker);
    }, this.#options.idleMs);
  }

  #add(worker: JobWorker): PoolWorker {
    const poolWorker: PoolWorker = { worker, job: undefined, idleTimer: undefined };
    this.#workers.add(poolWorker);
    if (this.#decoderUrl !== undefined) worker.postMessage({ decoderUrl: this.#decoderUrl });
    worker.onmessage = ({ data }) => {
      this.#finishJob(poolWorker, data);
    };
    worker.onerror = (event) => {
      // Jobs catch their own errors, so the worker's module did not load.
      event.preventDefault();
      this.#canStart = false;
      const { job } = poolWorker;
      this.#end(poolWorker);
      if (job) this.#waiting.unshift(job);
      this.#pump();
    };
    return poolWorker;
  }

  #finishJob(poolWorker: PoolWorker, answer: AnswerMessage): void {
    const { job } = poolWorker;
    poolWorker.job = undefined;
    if ("output" in answer) job?.resolve(answer.output);
    else job?.reject(asError(answer));
    this.#endWhenIdle(poolWorker);
    this.#pump();
  }

  #end(poolWorker: PoolWorker): void {
    clearTimeout(poolWorker.idleTimer);
    poolWorker.worker.terminate();
    this.#workers.delete(poolWorker);
  }

  /** Runs the job on the main thread after earlier ones, and yields to the page before it. */
  #runJobOnMainThread({ message, signal, resolve, reject }: Job): void {
    this.#mainThreadJobs = this.#mainThreadJobs.then(async () => {
      await new Promise((next) => {
        setTimeout(next);
      });
      if (!signal.aborted && !this.#isDisposed) await this.#options.runOnMainThread(message).then(resolve, reject);
    });
  }
}
