// Runs of frames in the files of a sequence. Frames follow one another in a file, so that a run of them is one job of a
// worker, which goes on from the last frame of the job before.

import type { Frame } from "../../decode/frame/frame.ts";
import type { RunJob } from "../../decode/jobs.ts";
import type { FrameForm, PackedFrame } from "../../decode/sequence/sequenceFrames.ts";
import type { SequenceIndex } from "../../decode/sequence/sequenceIndex.ts";
import { fileOfFrame } from "../../decode/sequence/sequenceIndex.ts";
import type { FrameRuns, SequenceFrame } from "./frameRuns.ts";

export interface PackedRunsOptions {
  readonly index: SequenceIndex;
  /** The frames of a file; undefined while it is absent; empty if it cannot be read. */
  readonly framesOf: (file: number) => readonly PackedFrame[] | undefined;
  readonly runJob: RunJob;
  /** What frames are decoded to now. */
  readonly form: () => FrameForm;
}

export class PackedRuns implements FrameRuns {
  readonly #options: PackedRunsOptions;
  /** The frame that was decoded last, from which a difference goes on. */
  #last: { readonly number: number; readonly components: Frame["components"] } | undefined;

  constructor(options: PackedRunsOptions) {
    this.#options = options;
  }

  decode(
    frame: number,
    upcoming: ReadonlySet<number>,
    signal: AbortSignal,
  ): Promise<readonly SequenceFrame[]> | undefined {
    const { index, framesOf } = this.#options;
    const frames = framesOf(fileOfFrame(index, frame));
    return frames === undefined || frames.length === 0 ? undefined : this.#run(frames, frame, upcoming, signal);
  }

  reset(): void {
    this.#last = undefined;
  }

  async #run(
    frames: readonly PackedFrame[],
    frame: number,
    upcoming: ReadonlySet<number>,
    signal: AbortSignal,
  ): Promise<readonly SequenceFrame[]> {
    const { runJob, form } = this.#options;
    const first = frames[0]?.number ?? 0;
    const target = frame - first;
    let start = target;
    while (start > 0 && frames[start]?.isDifference === true && this.#last?.number !== first + start - 1) start -= 1;
    let end = target + 1;
    while (end < frames.length && upcoming.has(first + end)) end += 1;
    const isContinued = frames[start]?.isDifference === true;
    const decoded = await runJob(
      "sequenceFrames",
      {
        frames: frames.slice(start, end).map(({ bytes }) => bytes),
        before: isContinued ? this.#last?.components : undefined,
        from: target - start,
        form: form(),
      },
      signal,
    );
    this.#last = { number: first + end - 1, components: decoded.last };
    return decoded.frames;
  }
}
