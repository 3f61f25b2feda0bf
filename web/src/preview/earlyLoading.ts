// Files that a preview requests before the runtime has been loaded, so that the line and the workers are not idle
// meanwhile: patches, and the index and the groups of meshes with levels of detail. The runtime takes over the
// scheduler, the workers and the files. A file that has failed is requested again by the runtime, which reports the
// error.

import type { LevelGroup } from "../decode/compact/levelGroup.ts";
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

export type EarlyKind = "patches" | "group" | "bytes";

/** The content of a file, by its kind. */
export type EarlyContent = { readonly byteLength: number } & (
  | { readonly patches: readonly PatchBuffers[] }
  | { readonly group: LevelGroup }
  | { readonly bytes: Uint8Array<ArrayBuffer> }
);

export interface EarlyRequest {
  /** `bytes`: the file is not decoded. */
  readonly kind: EarlyKind;
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
  readonly decoded: Promise<EarlyContent>;
}

interface RequestedFile extends EarlyFile {
  readonly kind: EarlyKind;
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
  request({ kind, url, expectedBytes, priority }: EarlyRequest, isFetchedByWorker = false): EarlyFile {
    const known = this.#files.get(url);
    if (known !== undefined) return known;
    const aborter = new AbortController();
    const arrival = new Arrival();
    const subject = { priority, remainingBytes: expectedBytes };
    const file: RequestedFile = {
      kind,
      aborter,
      isNear: arrival.isNear,
      hasStarted: false,
      decoded: this.#load(kind, url, subject, aborter.signal, arrival, () => {
        file.hasStarted = true;
        return isFetchedByWorker ? this.workers.runOnFile("compactPatches", url, aborter.signal) : undefined;
      }),
    };
    file.decoded.catch(() => undefined); // there may be no other handler
    this.#files.set(url, file);
    return file;
  }

  /**
   * Hands over the content of a file, once; undefined if the file has not been requested yet, or has been taken: the
   * caller requests it in an order of its own.
   */
  take(url: string): Promise<EarlyContent> | undefined {
    const file = this.#files.get(url);
    this.#files.delete(url);
    if (file === undefined || file.hasStarted) return file?.decoded;
    file.aborter.abort();
    return undefined;
  }

  /** Drops the files, or those of one kind, that nobody has taken. */
  dropFiles(kind?: EarlyKind): void {
    for (const [url, file] of this.#files) {
      if (kind !== undefined && file.kind !== kind) continue;
      file.aborter.abort();
      this.#files.delete(url);
    }
  }

  async #load(
    kind: EarlyKind,
    url: string,
    subject: JobSubject & { remainingBytes: number },
    signal: AbortSignal,
    arrival: Arrival,
    onStart: () => Promise<readonly PatchBuffers[]> | undefined,
  ): Promise<EarlyContent> {
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
    const { byteLength } = bytes; // decoding transfers the bytes
    if (kind === "bytes") return { byteLength, bytes };
    if (kind === "group") return { byteLength, group: await this.workers.run("compactGroup", bytes, signal) };
    const fetched = byWorker && (await Promise.race([byWorker, pause(maxWorkerMs, signal)]));
    return { byteLength, patches: fetched ?? (await this.workers.run("compactPatches", bytes, signal)) };
  }
}
