// A pool of workers that run one job each at a time. Workers are started when there are jobs, and ended when they have
// been idle for a while. Where no worker can be started (a runtime from another origin, a content security policy) jobs
// run on the main thread.

import type { InputOf, JobName, OutputOf } from "../decode/jobs.ts";
import type { AnswerMessage, DecoderMessage, FileJobMessage, JobMessage, WorkerMessage } from "./protocol.ts";
import { asError, decoderJobs } from "./protocol.ts";

/** The members of Worker that the pool uses. */
export interface JobWorker {
  onmessage: ((event: MessageEvent<AnswerMessage>) => void) | null;
  onerror: ((event: ErrorEvent) => void) | null;
  postMessage(message: WorkerMessage): void;
  terminate(): void;
}

export interface WorkerPoolOptions {
  readonly size: number;
  /** Starts a worker that receives these messages first; may throw. */
  readonly start: (messages: readonly (FileJobMessage | DecoderMessage)[]) => JobWorker;
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
  readonly message: JobMessage | FileJobMessage;
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
    return this.#enqueue({ name, input }, signal) as Promise<OutputOf<Name>>;
  }

  /**
   * Runs a job on a file that the worker fetches by itself, even while the page's thread is busy. The page should have
   * requested the file before: workers start later, and take it from the browser's cache. Also rejects where it cannot
   * be fetched, or no worker can be started.
   */
  runOnFile(name: "compactPatches", fileUrl: string, signal: AbortSignal): Promise<OutputOf<"compactPatches">> {
    return this.#enqueue({ name, fileUrl }, signal) as Promise<OutputOf<"compactPatches">>;
  }

  #enqueue(message: JobMessage | FileJobMessage, signal: AbortSignal): Promise<unknown> {
    return new Promise((resolve, reject) => {
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
      const job: Job = { message, signal, resolve: settled(resolve), reject: settled(reject) };
      if (decoderJobs.has(message.name)) this.requestDecoder();
      this.#waiting.push(job);
      this.#pump();
    });
  }

  /** Starts workers for this number of expected jobs, while their input is still loading. */
  prepare(jobCount: number): void {
    while (this.#workers.size < Math.min(jobCount, this.#options.size) && this.#canStart && !this.#isDisposed) {
      const idle = this.#tryStart([]);
      if (idle !== undefined) this.#endWhenIdle(idle);
    }
  }

  /**
   * Call where files of compact have been requested; has no effect from the second time on. `prefetch` may put the
   * module into the browser's cache, from which workers take it that are still starting.
   */
  requestDecoder(prefetch?: (url: string) => void): void {
    if (this.#isDecoderRequested || !this.#canStart || this.#isDisposed) return;
    this.#isDecoderRequested = true;
    const decoderUrl = (this.#decoderUrl = this.#options.decoderUrl());
    if (decoderUrl === undefined) return;
    prefetch?.(decoderUrl);
    for (const { worker } of this.#workers) worker.postMessage({ decoderUrl });
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
      const idle = Array.from(this.#workers).find(({ job }) => job === undefined);
      if (idle === undefined && this.#canStart && this.#workers.size >= this.#options.size) return;
      const job = this.#waiting.shift();
      if (job === undefined) return;
      if (idle !== undefined) {
        clearTimeout(idle.idleTimer);
        idle.job = job;
        idle.worker.postMessage(job.message);
      } else if (!this.#startWith(job)) {
        this.#runWithoutWorker(job);
      }
    }
  }

  /** Starts a worker for a job; returns whether that was possible. */
  #startWith(job: Job): boolean {
    const { message } = job;
    const started = this.#tryStart("fileUrl" in message ? [message] : []);
    if (started === undefined) return false;
    started.job = job;
    if (!("fileUrl" in message)) started.worker.postMessage(message);
    return true;
  }

  #tryStart(messages: readonly FileJobMessage[]): PoolWorker | undefined {
    if (!this.#canStart) return undefined;
    const decoderUrl = this.#decoderUrl;
    try {
      return this.#add(this.#options.start([...(decoderUrl === undefined ? [] : [{ decoderUrl }]), ...messages]));
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
  #runWithoutWorker({ message, signal, resolve, reject }: Job): void {
    if ("fileUrl" in message) {
      reject(new Error("no worker can be started"));
      return;
    }
    this.#mainThreadJobs = this.#mainThreadJobs.then(async () => {
      await new Promise((next) => {
        setTimeout(next);
      });
      if (!signal.aborted && !this.#isDisposed) await this.#options.runOnMainThread(message).then(resolve, reject);
    });
  }
}
