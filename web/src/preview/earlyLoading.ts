// Patches that a preview requests before the runtime has been loaded, so that the line and the workers are not idle
// meanwhile. The runtime takes over the scheduler, the workers and the patches. A file that has failed is requested
// again by the runtime, which reports the error.

import type { PatchBuffers } from "../decode/compact/patchBuffers.ts";
import { Arrival } from "../scheduler/arrival.ts";
import { defaultDownloadOptions, downloadInSlot } from "../scheduler/download.ts";
import { earlySlotCount } from "../scheduler/downloadSlots.ts";
import { pause } from "../scheduler/pause.ts";
import type { JobSubject } from "../scheduler/scheduler.ts";
import { Scheduler } from "../scheduler/scheduler.ts";
import { lineBitsPerSecond } from "../workers/lineRate.ts";
import { pageWorkers } from "../workers/pageWorkers.ts";
import type { WorkerPool } from "../workers/workerPool.ts";

/** The patches in one file. */
export interface EarlyPatches {
  readonly byteLength: number;
  readonly patches: readonly PatchBuffers[];
}

/** A file of patches. */
export interface PatchFileRequest {
  /** Absolute. */
  readonly url: string;
  /** An estimate. */
  readonly expectedBytes: number;
  /** Files of larger priority are requested first. */
  readonly priority: number;
}

export interface EarlyFile {
  /** Resolves when little of the file is still to come, or it has failed. */
  readonly isNear: Promise<unknown>;
  /** Rejects if the file cannot be downloaded or decoded. */
  readonly decoded: Promise<EarlyPatches>;
}

interface RequestedFile extends EarlyFile {
  readonly aborter: AbortController;
  /** Whether the file has been requested; otherwise it waits in the scheduler's queue. */
  hasStarted: boolean;
}

/**
 * A worker that fetches a file itself has answered within this time after the page has received the same file, or
 * another decodes the page's bytes: its own request may have stalled.
 */
const maxWorkerMs = 3000;

/** Starting the runtime keeps the page from sending requests for at least this long. */
const runtimeStartMs = 300;

export class EarlyLoading {
  readonly scheduler: Scheduler;
  readonly workers: WorkerPool;
  readonly #fetch: typeof fetch;
  readonly #files = new Map<string, RequestedFile>();

  constructor(
    scheduler = new Scheduler(earlySlotCount),
    workers = pageWorkers(),
    fetchFile: typeof fetch = defaultDownloadOptions.fetch,
  ) {
    this.scheduler = scheduler;
    scheduler.window.assume(((lineBitsPerSecond() ?? 0) / 8000) * runtimeStartMs);
    this.workers = workers;
    this.#fetch = fetchFile;
  }

  /**
   * Requests a file whenever the scheduler allows it, unless it has been requested before. With `isFetchedByWorker` a
   * worker waits for the same answer, and so decodes the patches even while the page's thread is busy.
   */
  request({ url, expectedBytes, priority }: PatchFileRequest, isFetchedByWorker = false): EarlyFile {
    const known = this.#files.get(url);
    if (known !== undefined) return known;
    const aborter = new AbortController();
    const arrival = new Arrival();
    const subject = { priority, remainingBytes: expectedBytes };
    const file: RequestedFile = {
      aborter,
      isNear: arrival.isNear,
      hasStarted: false,
      decoded: this.#load(url, subject, aborter.signal, arrival, () => {
        file.hasStarted = true;
        return isFetchedByWorker ? this.workers.runOnFile("compactPatches", url, aborter.signal) : undefined;
      }),
    };
    file.decoded.catch(() => undefined); // there may be no other handler
    this.#files.set(url, file);
    return file;
  }

  /**
   * Hands over the patches in a file, once; undefined if the file has not been requested yet, or has been taken: the
   * caller requests it in an order of its own.
   */
  take(url: string): Promise<EarlyPatches> | undefined {
    const file = this.#files.get(url);
    this.#files.delete(url);
    if (file === undefined || file.hasStarted) return file?.decoded;
    file.aborter.abort();
    return undefined;
  }

  /** Drops the files that nobody has taken. */
  dropFiles(): void {
    for (const { aborter } of this.#files.values()) aborter.abort();
    this.#files.clear();
  }

  async #load(
    url: string,
    subject: JobSubject & { remainingBytes: number },
    signal: AbortSignal,
    arrival: Arrival,
    onStart: () => Promise<readonly PatchBuffers[]> | undefined,
  ): Promise<EarlyPatches> {
    let byWorker: Promise<readonly PatchBuffers[] | undefined> | undefined;
    const expectedBytes = subject.remainingBytes;
    const listener = {
      onState: (state: string) => {
        if (state === "loading") byWorker = onStart()?.catch(() => undefined); // decoded from the page's bytes then
      },
      onBytes: (loadedBytes: number, totalBytes = expectedBytes) => {
        arrival.onBytes(loadedBytes, totalBytes);
        subject.remainingBytes = Math.max(0, totalBytes - loadedBytes);
      },
    };
    const options = { ...defaultDownloadOptions, fetch: this.#fetch, retries: 0 };
    const bytes = await downloadInSlot(this.scheduler, subject, url, signal, options, listener, (body) =>
      Promise.resolve(body),
    ).finally(() => {
      arrival.end();
    });
    const { byteLength } = bytes;
    const fetched = byWorker && (await Promise.race([byWorker, pause(maxWorkerMs, signal)]));
    const patches = fetched ?? (await this.workers.run("compactPatches", bytes, signal));
    return { byteLength, patches };
  }
}
