// The duration of a sequence, and which of its frames is due at a position.

import type { SequenceIndex } from "../../decode/sequence/sequenceIndex.ts";
import type { SequencePosition } from "../lateDeliveries.ts";

type Timing = Pick<SequenceIndex, "frameCount" | "rate">;

/** Times that are multiples of a frame's duration may lie just before it, by this part of it. */
const tolerance = 1e-6;

/** The number of the frame at a position. */
export function frameAt(position: SequencePosition, { frameCount, rate }: Timing): number {
  const frames = "seconds" in position ? position.seconds * rate : position.fraction * frameCount;
  return Math.max(0, Math.min(frameCount - 1, Math.floor(frames + tolerance)));
}

/** In seconds. */
export function durationOf({ frameCount, rate }: Timing): number {
  return frameCount / rate;
}
