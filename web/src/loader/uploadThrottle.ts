// Spreads the upload of images and arrays over frames. three.js uploads everything that a frame
// shows for the first time before that frame, so each frame gets only a few of them.

import { beforeNextFrame } from "../render/frames/nextFrame.ts";
import { FrameTaskQueue } from "../scheduler/frameTaskQueue.ts";

/** The same limit as of the element (viewer/uploadPipeline.ts). A larger array or image is passed on alone. */
const bytesPerFrame = 4 * 2 ** 20;

export class UploadThrottle {
  readonly #work = new FrameTaskQueue({
    bytesPerFrame,
    millisecondsPerFrame: Infinity,
    now: () => performance.now(),
    requestFrame: beforeNextFrame,
  });

  /** Resolves before a frame that may upload this many more bytes. Rejects with the signal's reason. */
  waitForFrame(bytes: number, signal: AbortSignal): Promise<void> {
    return this.#work.run([bytes].values(), signal);
  }
}
