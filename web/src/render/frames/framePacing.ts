// Frame pacing for frames that only refine the picture. A scene of many patches changes many times
// a second while it loads. A GPU that needs longer than a frame for each of these changes would
// have no time left for uploads. So after a frame that takes longer than `quickFrameMs`, the next
// such frame waits for twice that duration. No change is lost: the delayed frame shows all changes
// that have come meanwhile.

import { fencePassed } from "./gpuFence.ts";

/** Frames of up to this duration cause no delay. */
const quickFrameMs = 16;
/** Delay after a slower frame, as a multiple of its duration. */
const delayFactor = 2;
const maxDelayMs = 2000;

export class FramePacer {
  readonly #gl: WebGL2RenderingContext;
  #delay: Promise<void> | undefined;
  #isPending = false;
  /** Whether the frame that is being drawn was requested. */
  #wasRequested = false;

  constructor(gl: WebGL2RenderingContext) {
    this.#gl = gl;
  }

  /** Whether a frame has been requested and has not been drawn yet. */
  get isFramePending(): boolean {
    return this.#isPending;
  }

  /** Calls back immediately, or after the delay. Further requests before the next frame are ignored. */
  request(callback: () => void): void {
    if (this.#isPending) return;
    this.#isPending = true;
    if (this.#delay === undefined) callback();
    else
      void this.#delay.then(() => {
        if (this.#isPending) callback();
      });
  }

  /** Call before any frame is submitted to the GPU, whether or not it was requested with `request`. */
  begin(): void {
    this.#wasRequested = this.#isPending;
    this.#isPending = false;
  }

  /** Call after the frame has been submitted to the GPU. `begunAt`: when `begin` was called, by `performance.now()`. */
  end(begunAt: number): void {
    if (!this.#wasRequested || this.#delay !== undefined) return;
    this.#delay = delayAfter(this.#gl, begunAt).then(() => {
      this.#delay = undefined;
    });
  }
}

async function delayAfter(gl: WebGL2RenderingContext, begunAt: number): Promise<void> {
  const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
  gl.flush();
  await fencePassed(gl, fence);
  gl.deleteSync(fence);
  const durationMs = performance.now() - begunAt;
  if (durationMs > quickFrameMs)
    await new Promise((resolve) => {
      setTimeout(resolve, Math.min(delayFactor * durationMs, maxDelayMs));
    });
}
