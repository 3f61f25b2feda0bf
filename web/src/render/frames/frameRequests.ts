// When frames are drawn: at the browser's next animation frame after a change, however many changes request it, or
// later where frame pacing delays it.

import { FramePacer } from "./framePacing.ts";

export interface FrameRequestsListener {
  /** A change has requested a frame, which may differ from the last one. */
  onRequest(): void;
  /** Draws the requested frame. */
  draw(): void;
}

export class FrameRequests {
  readonly #listener: FrameRequestsListener;
  readonly #pacer: FramePacer;
  /** The handle of the animation frame that has been requested; 0 while there is none. */
  #animationFrame = 0;

  constructor(context: WebGL2RenderingContext, listener: FrameRequestsListener) {
    this.#listener = listener;
    this.#pacer = new FramePacer(context);
  }

  /** Whether a paced frame has been requested and has not been drawn yet. */
  get isPacedFramePending(): boolean {
    return this.#pacer.isFramePending;
  }

  request(): void {
    this.#listener.onRequest();
    if (this.#animationFrame === 0)
      this.#animationFrame = requestAnimationFrame(() => {
        this.#listener.draw();
      });
  }

  /**
   * Requests a frame that only refines the picture, with frame pacing: while a scene loads, such frames would
   * otherwise keep the GPU busy all the time.
   */
  requestPaced(): void {
    this.#pacer.request(() => {
      this.request();
    });
  }

  /** Call before any frame is drawn, requested or not: it shows what all requests are for. */
  begin(): void {
    this.cancel();
    this.#pacer.begin();
  }

  /** Call after the frame has been submitted to the GPU. `begunAt`: when it was begun, by `performance.now()`. */
  end(begunAt: number): void {
    this.#pacer.end(begunAt);
  }

  cancel(): void {
    cancelAnimationFrame(this.#animationFrame);
    this.#animationFrame = 0;
  }
}
