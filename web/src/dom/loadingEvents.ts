// What a page learns about loading: events and promises on <x3d> and on each
// <shape>. Events do not bubble. Those that speak of a picture (first-image,
// refine, load) are sent after the frame that shows it.

import type { StageName } from "../stage/stage.ts";
import { stageNames } from "../stage/stage.ts";
import type { Progress, Transfer } from "../delivery/progress.ts";
import { noProgress } from "../delivery/progress.ts";

export interface ProgressDetail extends Progress {
  /** What is on the screen. */
  readonly stage: StageName | "none";
}

export interface ErrorDetail {
  /** "http", "network", "timeout", "truncated", "malformed", "unsupported", "limit" or "webgl". */
  readonly type: string;
  /** The file as the document names it; "" where none is concerned. */
  readonly url: string;
  readonly element: Element;
  readonly message: string;
}

/** Properties that the runtime gives to <x3d> and to each <shape>. */
export interface Loadable {
  /** Resolves when something of it is on the screen. */
  readonly firstImage: Promise<undefined>;
  /**
   * Resolves when all that this view needs is on the screen. A shape's rejects where
   * a file of it failed; the scene's resolves even then, after the error events.
   */
  readonly complete: Promise<undefined>;
  /** What has failed so far, in order; of the scene, of all its shapes. */
  readonly errors: readonly ErrorDetail[];
  /** Every file that has been asked for, as far as it is now; of the scene, those of all its shapes. */
  readonly resources: readonly ResourceEntry[];
}

/** A file that an element needs. */
export interface ResourceEntry {
  /** As the document names it. */
  readonly url: string;
  readonly state: Transfer["state"];
  readonly loadedBytes: number;
  /** An estimate until the server says, exact in the end. */
  readonly totalBytes: number;
  /** Requests sent for it so far. */
  readonly tries: number;
  /** Why it is of no use; null while it may be. */
  readonly error: string | null;
}

/** The loading of one element, from its start to `load`. */
export class LoadingEvents {
  readonly #element: Element;
  readonly #firstImage = Promise.withResolvers<undefined>();
  readonly #complete = Promise.withResolvers<undefined>();
  #progress: Progress = noProgress;
  /** What the next frame will show, and what the last one has. */
  #stage: StageName | "none" = "none";
  #shownStage: StageName | "none" = "none";
  #outcome: "loading" | "settled" | "ended" | "abandoned" = "loading";
  #error: Error | undefined;
  readonly #errors: ErrorDetail[] = [];

  /** Puts fresh promises, and an empty list of errors, on the element. `shown`: its first image has been seen, and told. */
  constructor(
    element: Element,
    transfers: () => readonly Readonly<Transfer>[] = () => [],
    shown: StageName | "none" = "none",
  ) {
    this.#element = element;
    this.#stage = this.#shownStage = shown;
    if (shown !== "none") this.#firstImage.resolve(undefined);
    const properties: Omit<Loadable, "resources"> = {
      firstImage: this.#firstImage.promise,
      complete: this.#complete.promise,
      errors: this.#errors,
    };
    for (const [name, value] of Object.entries(properties)) {
      Object.defineProperty(element, name, { value: value, configurable: true, enumerable: true });
    }
    Object.defineProperty(element, "resources", {
      get: () => transfers().map(entryOf),
      configurable: true,
      enumerable: true,
    });
    // Nobody has to listen; a rejection must not show up as an unhandled one.
    for (const { promise } of [this.#firstImage, this.#complete]) promise.catch(() => undefined);
  }

  get progress(): Progress {
    return this.#progress;
  }

  /** This view needs nothing more. */
  get isSettled(): boolean {
    return this.#outcome !== "loading";
  }

  /** `load` has been sent, or nothing will be. */
  get isEnded(): boolean {
    return this.#outcome === "ended" || this.#outcome === "abandoned";
  }

  get stage(): StageName | "none" {
    return this.#stage;
  }

  /** Stages only ever rise. */
  reach(stage: StageName | "none"): void {
    if (rankOf(stage) > rankOf(this.#stage)) this.#stage = stage;
  }

  updateProgress(progress: Progress): void {
    const { totalProgress, loadedBytes } = this.#progress;
    if (progress.totalProgress === totalProgress && progress.loadedBytes === loadedBytes) return;
    this.#progress = progress;
    const detail: ProgressDetail = { ...progress, stage: this.#shownStage };
    this.#send("progress", detail);
  }

  fail(detail: ErrorDetail, error: Error): void {
    this.#error ??= error;
    this.#errors.push(detail);
    this.#send("error", detail);
  }

  /** Says that this view needs nothing more. */
  settle(): void {
    if (this.#outcome === "loading") this.#outcome = "settled";
  }

  /** A frame with everything reached so far is on the screen. After `load`, a nearer look may still refine. */
  onFrame(isScene: boolean): void {
    if (this.#outcome === "abandoned") return;
    if (this.#stage !== this.#shownStage) {
      const isFirst = this.#shownStage === "none";
      this.#shownStage = this.#stage;
      if (isFirst) {
        this.#firstImage.resolve(undefined);
        this.#send("first-image", { stage: this.#stage });
      } else {
        this.#send("refine", { stage: this.#stage });
      }
    }
    if (this.#outcome !== "settled") return;
    this.#outcome = "ended";
    if (this.#error === undefined || isScene) {
      this.#firstImage.resolve(undefined); // an empty scene has shown all it has
      this.#complete.resolve(undefined);
      this.#send("load", {});
    } else {
      this.#firstImage.reject(this.#error);
      this.#complete.reject(this.#error);
    }
  }

  /** The element is gone or begins anew. */
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

/** The least of some stages: a scene is as far as its last shape. */
export function lowestStageOf(stages: readonly (StageName | "none")[]): StageName | "none" {
  return stages.reduce((least, stage) => (rankOf(stage) < rankOf(least) ? stage : least), stages[0] ?? "none");
}
