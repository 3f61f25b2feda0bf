// Spreads the upload of images and arrays over frames. three.js uploads everything that a frame
// displays for the first time before that frame, so this class limits what can be new in a frame.

import { beforeNextFrame } from "../render/frames/nextFrame.ts";
import { FrameTaskQueue, uploadBytesPerFrame } from "../scheduler/frameTaskQueue.ts";

export class UploadThrottle {
  readonly #queue = new FrameTaskQueue({
    bytesPerFrame: uploadBytesPerFrame,
    millisecondsPerFrame: Infinity, // three.js uploads later, so the time cannot be measured here
    now: () => performance.now(),
    requestFrame: beforeNextFrame,
  });

  /**
   * Resolves before a frame that may upload this many more bytes. An array or image larger than the limit is the last
   * upload of its frame. Rejects with the signal's reason.
   */
  waitForFrame(bytes: number, signal: AbortSignal): Promise<void> {
    return this.#queue.run([bytes].values(), signal);
  }
}
