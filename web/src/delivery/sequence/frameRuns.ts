// Where decoded frames of a sequence come from: its files, or a video of the same frames.

import type { FrameArrays } from "../../decode/frame/frameArrays.ts";
import type { FrameImages } from "../../decode/frame/frameImages.ts";

export type SequenceFrame = FrameImages | FrameArrays;

export interface FrameRuns {
  /**
   * Decodes a frame and the upcoming ones right behind it, as far as one run of the decoder has them. Undefined while
   * its bytes are absent, or where they cannot be read. Rejects with DecodeError, or with the signal's reason. Not called
   * again before it has ended or been aborted.
   */
  decode(
    frame: number,
    upcoming: ReadonlySet<number>,
    signal: AbortSignal,
  ): Promise<readonly SequenceFrame[]> | undefined;
  /** Frames are decoded to another form from now on, or nobody waits for what is being decoded. */
  reset(): void;
}
