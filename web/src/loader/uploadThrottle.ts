// Images and arrays on their way into somebody's three.js scene. Which renderer
// draws them, and when, is the app's business; three.js uploads all that a frame
// shows for the first time before that frame. So they are let into the scene a few
// at a time, and no frame waits for many.

import { beforeNextFrame } from "../render/frames/nextFrame.ts";
import { FrameTaskQueue } from "../scheduler/frameTaskQueue.ts";

/** As the element takes (dom/arrival.ts); what is larger comes alone. */
const bytesPerFrame = 4 * 2 ** 20;

export class UploadThrottle {
  readonly #work = new FrameTaskQueue({
    bytesPerFrame,
    millisecondsPerFrame: Infinity,
    now: () => performance.now(),
    requestFrame: beforeNextFrame,
  });

  /** Resolves before a frame that may show so many bytes more. Rejects with the signal's reason. */
  waitForFrame(bytes: number, signal: AbortSignal): Promise<void> {
    return this.#work.run([bytes].values(), signal);
  }
}
