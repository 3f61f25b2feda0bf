// Reads `latest` of a live stream (docs/live.md): what all its frames have in common, and the newest number.

import { DecodeError } from "../../decode/decodeError.ts";
import type { FrameDescription } from "../../decode/frame/frameDescription.ts";
import { numberIn, objectIn, readFrameDescription } from "../../decode/frame/frameDescription.ts";

export interface StreamState extends FrameDescription {
  /** The number of the first frame with this layout and lattice. */
  readonly epoch: number;
  /** The newest frame; undefined before the first. */
  readonly number: number | undefined;
  /** The number that comes next. */
  readonly next: number;
  /** When the server had the newest frame, in milliseconds of its clock; undefined before the first. */
  readonly addedAt: number | undefined;
  /** The server's clock when it answered. */
  readonly now: number;
  /** Whether a cache shares frames among viewers, who request each frame when it is there. */
  readonly isTimed: boolean;
  readonly hasEnded: boolean;
}

/** Checks untrusted text. Throws DecodeError. */
export function readStreamState(text: string): StreamState {
  const json = objectIn(text, "description of a stream");
  const frameNumber = (name: string): number => {
    const value = numberIn(json, name);
    if (!Number.isSafeInteger(value) || value < 0)
      throw new DecodeError("malformed", `states no frame number as "${name}"`);
    return value;
  };
  return {
    ...readFrameDescription(json),
    epoch: frameNumber("epoch"),
    number: json.number === null ? undefined : frameNumber("number"),
    next: frameNumber("next"),
    addedAt: typeof json.added === "number" ? json.added : undefined,
    now: json.now === undefined ? 0 : numberIn(json, "now"),
    isTimed: json.timed === true,
    hasEnded: json.ended === true,
  };
}
