// The loading of a page's scene as a whole: its progress, and the events of <x3d>, of its shapes and of its Inlines.

import type { DeliveryError } from "../delivery/deliveryError.ts";
import type { StageName } from "../stage/stage.ts";
import { Throttle } from "../viewer/throttle.ts";
import type { ViewerCore } from "../viewer/viewerCore.ts";
import { progressIntervalMs } from "../viewer/viewerCore.ts";
import { LoadingEvents } from "./loadingEvents.ts";
import type { PageInlines } from "./pageInlines.ts";
import type { PageShape, PageShapes } from "./pageShapes.ts";
import { displayedStageOf } from "./pageShapes.ts";
import type { PageSurroundings } from "./pageSurroundings.ts";

/** What loads. */
export interface LoadingParts {
  readonly core: Pick<ViewerCore<PageShape>, "transfers" | "progressSince" | "isLoadingParts">;
  readonly shapes: PageShapes;
  readonly inlines: PageInlines;
  readonly surroundings: Pick<PageSurroundings, "isSettled">;
}

export interface SceneLoadingListener {
  /** `share`: 0 … 1 of the bytes of all files. `stage`: what the last frame displays. */
  onProgress(share: number, stage: StageName | "none"): void;
  /** Whether nothing but the scene is still to be loaded. */
  maySettle(): boolean;
}

export class SceneLoading {
  readonly #x3d: Element;
  readonly #parts: LoadingParts;
  readonly #listener: SceneLoadingListener;
  #events: LoadingEvents;
  readonly #progress = new Throttle(progressIntervalMs, () => {
    this.#updateProgress();
  });

  /** `parts`: may be incomplete for now. `previewStage`: what a preview displays of all shapes. */
  constructor(x3d: Element, parts: LoadingParts, previewStage: StageName | "none", listener: SceneLoadingListener) {
    this.#x3d = x3d;
    this.#parts = parts;
    this.#listener = listener;
    this.#events = this.#makeEvents(previewStage);
  }

  /** Begins anew where a scene that has loaded has further shapes to load, or needs a further part of the runtime. */
  join(): void {
    const { core, shapes } = this.#parts;
    if ((shapes.isLoading || core.isLoadingParts) && this.#events.isEnded) this.#events = this.#makeEvents("none");
  }

  /** Updates the progress soon. */
  requestProgress(): void {
    this.#progress.request();
  }

  /** `loading`: the events of the shape or Inline that the file belongs to. */
  fail(error: DeliveryError, element: Element, loading?: LoadingEvents): void {
    const detail = { type: error.kind, url: error.url, element, message: error.message };
    loading?.fail(detail, error);
    this.#events.fail(detail, error);
  }

  /** Sends the events of what a frame displays. */
  onFrame(): void {
    const { core, shapes, inlines, surroundings } = this.#parts;
    if (shapes.isQuiet && inlines.isQuiet && this.#events.isEnded) return;
    const awaited = [...shapes.visibleLoadings, ...inlines.loadings];
    // Shapes that have failed before their first stage do not hold back the scene's stage.
    this.#events.reach(
      displayedStageOf(
        awaited.filter(({ stage, isSettled }) => stage !== "none" || !isSettled).map(({ stage }) => stage),
      ),
    );
    this.#progress.callNow(); // so that an element's last `progress` precedes its `load`
    // The scene settles only after a frame: until then further shapes may join.
    const areSettled = surroundings.isSettled && awaited.every((loading) => loading.isSettled);
    if (!core.isLoadingParts && areSettled && this.#listener.maySettle()) this.#events.settle();
    shapes.onFrame();
    inlines.onFrame();
    this.#events.onFrame(true);
  }

  dispose(): void {
    this.#progress.cancel();
    this.#events.abandon();
  }

  #makeEvents(previewStage: StageName | "none"): LoadingEvents {
    return new LoadingEvents(this.#x3d, () => this.#parts.core.transfers, previewStage);
  }

  #updateProgress(): void {
    const { core, shapes } = this.#parts;
    shapes.updateProgress();
    if (!this.#events.isEnded) this.#events.updateProgress(core.progressSince(this.#events.progress));
    this.#listener.onProgress(this.#events.progress.totalProgress, this.#events.stage);
  }
}
