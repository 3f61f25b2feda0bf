// What a page's view fetches and decodes files with: its scheduler, its workers, and what a preview has loaded already.

import type { ResourcePool } from "../delivery/resourcePool.ts";
import type { EarlyLoading } from "../preview/earlyLoading.ts";
import type { Preview } from "../preview/preview.ts";
import type { SceneRenderer } from "../render/sceneRenderer.ts";
import type { SceneChanges } from "../render/shapes/shapeChanges.ts";
import { slotCountFor } from "../scheduler/downloadSlots.ts";
import { Scheduler } from "../scheduler/scheduler.ts";
import { pageWorkers } from "../workers/pageWorkers.ts";
import type { WorkerPool } from "../workers/workerPool.ts";
import { watchNetworkProtocol } from "./networkProtocol.ts";
import type { PagePoolOptions } from "./pagePool.ts";
import { makePagePool } from "./pagePool.ts";
import type { PageShapes } from "./pageShapes.ts";

export class PageResources {
  readonly pool: ResourcePool;
  readonly #early: EarlyLoading | undefined;
  readonly #scheduler: Scheduler;
  readonly #workers: WorkerPool;
  /** Whether a preview has displayed the scene, and so decoded the bases. */
  readonly #isPreviewed: boolean;

  constructor(
    renderer: SceneRenderer,
    preview: Pick<Preview, "shapes" | "early"> | undefined,
    options: Omit<PagePoolOptions, "early">,
  ) {
    const early = preview?.early;
    this.#early = early;
    this.#isPreviewed = preview !== undefined && preview.shapes.length > 0;
    this.#scheduler = early?.scheduler ?? new Scheduler(slotCountFor(""));
    this.#scheduler.slotCount = slotCountFor("");
    this.#workers = early?.workers ?? pageWorkers();
    this.pool = makePagePool(renderer, this.#scheduler, this.#workers, { ...options, early });
  }

  /** Requests ever sent, retries included, and those that have not ended. */
  get counts(): { readonly requests: number; readonly openRequests: number } {
    const { startedCount, runningCount, waitingCount } = this.#scheduler;
    return { requests: startedCount, openRequests: runningCount + waitingCount };
  }

  /** Allows as many requests at once as the network protocol suggests, until `signal` aborts. */
  start(signal: AbortSignal): void {
    watchNetworkProtocol(signal, (protocol) => {
      this.#scheduler.slotCount = slotCountFor(protocol);
    });
  }

  /** Call when the files of shapes have been requested: prepares workers for them. */
  prepare(shapes: Pick<PageShapes, "workerJobCount" | "hasCompact">): void {
    this.#early?.dropFiles("patches"); // the others are not needed now
    this.#workers.prepare(shapes.workerJobCount);
    if (shapes.hasCompact) this.#workers.requestDecoder();
  }

  /** Shapes have changed: prepares the main thread for their bases. */
  prepareBases({ shapes }: SceneChanges): void {
    const hasBase = Array.from(shapes.values()).some(({ geometry }) => geometry?.base !== undefined);
    if (hasBase && !this.#isPreviewed) this.#workers.prepareMainThread();
  }

  /** Call when everything has been loaded. */
  onComplete(): void {
    this.#early?.dropFiles();
  }

  dispose(): void {
    this.#workers.dispose();
  }
}
