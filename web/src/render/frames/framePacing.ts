// Frames that only make the picture finer, at a pace that the GPU can hold. A
// scene of many patches changes many times a second while it arrives; a GPU that
// takes longer than a frame for it would draw all of these and have no time left
// for what they wait for. So after such a frame it rests twice as long as that
// took. The last change of all waits for nobody.

import { fencePassed } from "./gpuFence.ts";

/** Frames of up to this many milliseconds need no rest after them. */
const quickFrameMs = 16;
const restPerFrame = 2;
const longestRestMs = 2000;

export class FramePacer {
  readonly #gl: WebGL2RenderingContext;
  #rest: Promise<void> | undefined;
  #isAsked = false;
  #wasAsked = false;

  constructor(gl: WebGL2RenderingContext) {
    this.#gl = gl;
  }

  /** Somebody has asked, and the frame has not come yet. */
  get isFramePending(): boolean {
    return this.#isAsked;
  }

  /** Calls back in this turn of the event loop where the GPU has rested, and once however often it is asked. */
  request(callback: () => void): void {
    if (this.#isAsked) return;
    this.#isAsked = true;
    if (this.#rest === undefined) callback();
    else
      void this.#rest.then(() => {
        if (this.#isAsked) callback();
      });
  }

  /** A frame is about to be given to the GPU, whoever asked for it. */
  begin(): void {
    this.#wasAsked = this.#isAsked;
    this.#isAsked = false;
  }

  /** It has been given to the GPU. */
  end(begunAt: number): void {
    if (!this.#wasAsked || this.#rest !== undefined) return;
    this.#rest = restAfter(this.#gl, begunAt).then(() => {
      this.#rest = undefined;
    });
  }
}

async function restAfter(gl: WebGL2RenderingContext, begunAt: number): Promise<void> {
  const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
  gl.flush();
  await fencePassed(gl, fence);
  gl.deleteSync(fence);
  const took = performance.now() - begunAt;
  if (took > quickFrameMs)
    await new Promise((resolve) => {
      setTimeout(resolve, Math.min(restPerFrame * took, longestRestMs));
    });
}
