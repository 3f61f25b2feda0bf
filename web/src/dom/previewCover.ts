// Covers the view's own canvas with the picture of a preview, which is drawn before the runtime has loaded, until the
// view displays more of the scene, or until a change.

import type { Preview } from "../preview/preview.ts";
import type { PageViewer } from "./pageViewer.ts";

/** What the cover needs of the view. */
export interface CoveredView {
  readonly canvas: HTMLCanvasElement;
  readonly viewer: PageViewer;
  /** Whether the camera stands where it has been since the first frame, and nothing will move it by itself. */
  readonly isStill: () => boolean;
  readonly onEnd: () => void;
}

export class PreviewCover {
  readonly #view: CoveredView;
  /** Undefined after its end. */
  #preview: Preview | undefined;
  /** Whether everything has been loaded. */
  #isComplete = false;
  /** Whether the pointer or the focus has been in the view. */
  #isVisited = false;

  /** `signal`: the view is disposed of. */
  constructor(preview: Preview, view: CoveredView, signal: AbortSignal) {
    this.#view = view;
    this.#preview = preview;
    const { canvas, viewer } = view;
    preview.onEnd = () => {
      this.#preview = undefined;
      // Otherwise the page would show an empty canvas from now on.
      const isEmpty = viewer.renderer.statistics.frames === 0;
      if (isEmpty && canvas.classList.contains("covered") && !signal.aborted) viewer.renderer.draw();
      canvas.classList.remove("covered");
      view.onEnd();
    };
    if (preview.shapes.length > 0) canvas.classList.add("covered");
    for (const type of ["pointerenter", "focus"])
      canvas.addEventListener(
        type,
        () => {
          this.#onVisit();
        },
        { once: true, signal },
      );
  }

  /** Whether the preview has not ended. */
  get isThere(): boolean {
    return this.#preview !== undefined;
  }

  /**
   * Whether the preview shows as much as has been loaded, and nothing has changed since: the view need not draw the
   * same picture. Frames that are requested after everything has been loaded show a change.
   */
  get isCurrent(): boolean {
    const { viewer, isStill } = this.#view;
    return (
      this.#preview?.isExact === true &&
      !this.#preview.shapes.some((shape) => viewer.scene.shapes.refines(shape)) &&
      !this.#isComplete &&
      !this.#isVisited &&
      viewer.cameraController.isAtHome &&
      !viewer.cameraController.isMoving &&
      isStill()
    );
  }

  /** The viewer has begun to load: it has taken over the files of a preview that is not drawn yet. */
  onStart(): void {
    if (this.#preview?.shapes.length === 0) this.#preview.end();
  }

  /** Call after each frame of the view. */
  onFrame(): void {
    if (this.#preview && !this.isCurrent && this.#isDisplayed(this.#preview)) this.#preview.end();
  }

  /** Everything has been loaded. */
  onComplete(): void {
    this.#isComplete = true;
    this.#preview?.freeze();
  }

  end(): void {
    this.#preview?.end();
  }

  /** Whether all patches that the preview displays are displayed by the view, or have failed. */
  #isDisplayed(preview: Preview): boolean {
    const { core, shapes } = this.#view.viewer.scene;
    return core.isDisplayed && preview.shapes.every((shape) => shapes.displays(shape));
  }

  /**
   * Draws the scene, which ends the preview, before the user begins a gesture: the first frame compiles programs and
   * takes longer than others.
   */
  #onVisit(): void {
    this.#isVisited = true;
    if (this.#preview !== undefined) this.#view.viewer.renderer.frames.request();
  }
}
