// Loading events and promises of <x3d>, of each <shape> and of each <inline>. Events do
// not bubble. Events about what is displayed (first-image, refine, load) are dispatched
// after the frame that displays it.

import type { StageName } from "../stage/stage.ts";
import { stageNames } from "../stage/stage.ts";
import type { DisplayedFrame } from "../viewer/displayedFrames.ts";
import type { Progress, Transfer } from "../delivery/progress.ts";
import { noProgress } from "../delivery/progress.ts";

export interface ProgressDetail extends Progress {
  /** The stage that the last frame displays. */
  readonly stage: StageName | "none";
}

export interface ErrorDetail {
  /** "http", "network", "timeout", "truncated", "malformed", "unsupported", "limit" or "webgl". */
  readonly type: string;
  /** The file's URL as the document writes it; "" for an error without a file. */
  readonly url: string;
  readonly element: Element;
  readonly message: string;
}

/** Properties that the runtime adds to <x3d> and to each <shape>. */
export interface Loadable {
  /** Resolves when the element displays something for the first time. */
  readonly firstImage: Promise<undefined>;
  /**
   * Resolves when everything that the view needs is displayed. A shape's promise rejects
   * if one of its files has failed; the scene's resolves even then, after the error
   * events.
   */
  readonly complete: Promise<undefined>;
  /** The errors so far, in order; of <x3d>, those of all its shapes. */
  readonly errors: readonly ErrorDetail[];
  /** The state of every requested file; of <x3d>, those of all its shapes. */
  readonly resources: readonly ResourceEntry[];
}

/** A file that an element needs. */
export interface ResourceEntry {
  /** The URL as the document writes it. */
  readonly url: string;
  readonly state: Transfer["state"];
  readonly loadedBytes: number;
  /** An estimate until the server answers, exact once the file has been fetched. */
  readonly totalBytes: number;
  /** Requests sent for the file so far. */
  readonly tries: number;
  /** Why the file has failed; null otherwise. */
  readonly error: string | null;
}

/** The events and promises of one element, from the start of loading to `load`. */
export class LoadingEvents {
  readonly #element: Element;
  readonly #firstImage = Promise.withResolvers<undefined>();
  readonly #complete = Promise.withResolvers<undefined>();
  #progress: Progress = noProgress;
  /** The stage that the next frame displays, and the one that the last frame has displayed. */
  #stage: StageName | "none" = "none";
  #displayedStage: StageName | "none" = "none";
  #outcome: "loading" | "settled" | "ended" | "abandoned" = "loading";
  #error: Error | undefined;
  readonly #errors: ErrorDetail[] = [];
  /** The frame of a live stream that the next frame of the page displays. */
  #frame: DisplayedFrame | undefined;

  /**
   * Sets new promises and an empty list of errors on the element. `previewStage`: the stage that a preview displays,
   * whose `first-image` event has been sent.
   */
  constructor(
    element: Element,
    transfers: () => readonly Readonly<Transfer>[] = () => [],
    previewStage: StageName | "none" = "none",
  ) {
    this.#element = element;
    this.#stage = this.#displayedStage = previewStage;
    if (previewStage !== "none") this.#firstImage.resolve(undefined);
    const properties: Omit<Loadable, "resources"> = {
      firstImage: this.#firstImage.promise,
      complete: this.#complete.promise,
      errors: this.#errors,
    };
    for (const [name, value] of Object.entries(properties)) {
      Object.defineProperty(element, name, { value, configurable: true, enumerable: true });
    }
    Object.defineProperty(element, "resources", {
      get: () => transfers().map(entryOf),
      configurable: true,
      enumerable: true,
    });
    // A page need not use the promises: their rejections must not be reported as unhandled.
    for (const { promise } of [this.#firstImage, this.#complete]) promise.catch(() => undefined);
  }

  get progress(): Progress {
    return this.#progress;
  }

  /** Whether the view needs nothing more. */
  get isSettled(): boolean {
    return this.#outcome !== "loading";
  }

  /** Whether the last event has been sent. */
  get isEnded(): boolean {
    return this.#outcome === "ended" || this.#outcome === "abandoned";
  }

  get stage(): StageName | "none" {
    return this.#stage;
  }

  /** Call it when the next frame will display this stage. A lower stage than before is ignored. */
  reach(stage: StageName | "none"): void {
    if (rankOf(stage) > rankOf(this.#stage)) this.#stage = stage;
  }

  /** Call it when the next frame will display this frame of a live stream. Those in between count as skipped. */
  displayFrame(frame: DisplayedFrame): void {
    const skipped = frame.skipped + (this.#frame === undefined ? 0 : this.#frame.skipped + 1);
    this.#frame = { ...frame, skipped };
  }

  /** The frame of which no event has told yet. */
  get waitingFrame(): DisplayedFrame | undefined {
    return this.#frame;
  }

  updateProgress(progress: Progress): void {
    const { totalProgress, loadedBytes } = this.#progress;
    if (progress.totalProgress === totalProgress && progress.loadedBytes === loadedBytes) return;
    this.#progress = progress;
    const detail: ProgressDetail = { ...progress, stage: this.#displayedStage };
    this.#send("progress", detail);
  }

  fail(detail: ErrorDetail, error: Error): void {
    this.#error ??= error;
    this.#errors.push(detail);
    this.#send("error", detail);
  }

  /** Call it when the view needs nothing more: the next `onFrame` sends `load` or rejects the promises. */
  settle(): void {
    if (this.#outcome === "loading") this.#outcome = "settled";
  }

  /**
   * Call it when a frame has displayed the stage reached so far; sends the events about it. `isScene`: the element is
   * the <x3d>. After `load`, a `refine` may follow when the camera comes nearer.
   */
  onFrame(isScene: boolean): void {
    if (this.#outcome === "abandoned") return;
    const frame = this.#frame;
    this.#frame = undefined;
    if (this.#stage !== this.#displayedStage) {
      const isFirst = this.#displayedStage === "none";
      this.#displayedStage = this.#stage;
      if (isFirst) {
        this.#firstImage.resolve(undefined);
        this.#send("first-image", { stage: this.#stage });
      } else {
        this.#send("refine", { stage: this.#stage });
      }
    }
    if (frame !== undefined) this.#send("frame", frame);
    if (this.#outcome !== "settled") return;
    this.#outcome = "ended";
    if (this.#error === undefined || isScene) {
      this.#firstImage.resolve(undefined); // an empty scene has no first image
      this.#complete.resolve(undefined);
      this.#send("load", {});
    } else {
      this.#firstImage.reject(this.#error);
      this.#complete.reject(this.#error);
    }
  }

  /** Call it when the element has been removed or loads another geometry: no event follows. */
  abandon(reason: Error = new DOMException("The element was removed or its geometry replaced.", "AbortError")): void {
    const wasEnded = this.isEnded;
    this.#outcome = "abandoned";
    if (wasEnded) return;
    this.#firstImage.reject(reason);
    this.#complete.reject(reason);
  }

  #send(name: string, detail: object): void {
    this.#element.dispatchEvent(new CustomEvent(name, { detail, bubbles: false }));
  }
}

function entryOf({ url, state, loadedBytes, totalBytes, tries, error }: Readonly<Transfer>): ResourceEntry {
  return { url, state, loadedBytes, totalBytes, tries, error: error ?? null };
}

function rankOf(stage: StageName | "none"): number {
  return stage === "none" ? -1 : stageNames.indexOf(stage);
}

/** Whether a stage is the other one or a better one. */
export function reachesStage(stage: StageName | "none", other: StageName | "none"): boolean {
  return rankOf(stage) >= rankOf(other);
}

/** The lowest of the stages; "none" if there are none. */
export function lowestStageOf(stages: readonly (StageName | "none")[]): StageName | "none" {
  return stages.reduce((lowest, stage) => (rankOf(stage) < rankOf(lowest) ? stage : lowest), stages[0] ?? "none");
}
