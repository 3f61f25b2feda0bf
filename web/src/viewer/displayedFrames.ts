// Counts the frames of live streams that a shape displays, and finds those that it has displayed or that are too late.

import type { LiveFrame } from "../delivery/geometryDelivery.ts";
import type { GeometryDescription } from "../document/description.ts";

/** A frame of a live stream that the shape displays. */
export interface DisplayedFrame extends Omit<LiveFrame, "epoch"> {
  /** Number of frames between this one and the one before, of the same stream. */
  readonly skipped: number;
}

export class DisplayedFrames {
  /** The frame that was displayed last, and the address of its stream. */
  #last: (Pick<LiveFrame, "number" | "epoch"> & { readonly stream: string | undefined }) | undefined;

  /** Whether a geometry with this frame would take its stream back to an earlier frame. */
  isEarlier(geometry: GeometryDescription, frame: LiveFrame | undefined): boolean {
    const last = this.#last;
    if (frame === undefined || last === undefined || last.stream !== streamOf(geometry)) return false;
    return frame.epoch === last.epoch && frame.number < last.number;
  }

  /**
   * Counts a frame that is displayed now; undefined: it has been displayed already. Frames are numbered consecutively,
   * so that none is missed in the count, whichever delivery of a stream they come from: another form of the same stream
   * has another delivery.
   */
  display(geometry: GeometryDescription, { number, epoch, time }: LiveFrame): DisplayedFrame | undefined {
    const stream = streamOf(geometry);
    const last = this.#last?.stream === stream ? this.#last?.number : undefined;
    if (number === last) return undefined;
    this.#last = { stream, number, epoch };
    return { number, time, skipped: last === undefined ? 0 : Math.max(0, number - last - 1) };
  }
}

/** The address of a live stream; for other geometry without meaning. */
function streamOf({ patches: [patch] }: GeometryDescription): string | undefined {
  return patch?.coord[0]?.url;
}
