// The decoded frames of a sequence: the one that is due and a few after it, which workers decode ahead. Frames follow
// one another in a file, so that a run of them is one job, which goes on from the last frame of the job before.

import type { FrameArrays } from "../../decode/frame/frameArrays.ts";
import type { Frame } from "../../decode/frame/frame.ts";
import type { FrameImages } from "../../decode/frame/frameImages.ts";
import { unpackedBytesOf } from "../../decode/frame/frameHeader.ts";
import type { RunJob } from "../../decode/jobs.ts";
import type { FrameForm, PackedFrame } from "../../decode/sequence/sequenceFrames.ts";
import type { SequenceIndex } from "../../decode/sequence/sequenceIndex.ts";
import { fileOfFrame } from "../../decode/sequence/sequenceIndex.ts";

export type SequenceFrame = FrameImages | FrameArrays;

/** Decoded frames that wait: at most so many, of so many bytes, but always two. */
const maxFramesAhead = 8;
const maxBytesAhead = 16 * 2 ** 20;

export interface FramesAheadOptions {
  readonly index: SequenceIndex;
  /** The frames of a file; undefined while it is absent; empty if it cannot be read. */
  readonly framesOf: (file: number) => readonly PackedFrame[] | undefined;
  readonly runJob: RunJob;
  /** What frames are decoded to now. */
  readonly form: () => FrameForm;
  /** Further frames have been decoded. */
  readonly onFrames: () => void;
  /** A file holds a frame that cannot be decoded. */
  readonly onError: (file: number, error: unknown) => void;
}

export class FramesAhead {
  readonly #options: FramesAheadOptions;
  readonly #limit: number;
  readonly #ready = new Map<number, SequenceFrame>();
  /** The frame that was decoded last, from which a difference goes on. */
  #last: { readonly number: number; readonly components: Frame["components"] } | undefined;
  /** The frame that was due last, and how many frames before it have been due since the last jump. */
  #due: number | undefined;
  #maxLag = 0;
  #aborter = new AbortController();
  #isBusy = false;

  constructor(options: FramesAheadOptions) {
    this.#options = options;
    const frameBytes = 2 * unpackedBytesOf(options.index);
    this.#limit = Math.max(2, Math.min(maxFramesAhead, Math.floor(maxBytesAhead / frameBytes)));
  }

  /**
   * Takes the frame that is to be displayed when `due` is: itself, or else, where decoding is late, the last one before
   * it that is ready and comes after `displayed`; undefined where there is none. After a jump, frames that
   * were due before it do not count.
   */
  take(due: number, displayed: number | undefined): SequenceFrame | undefined {
    const { frameCount } = this.#options.index;
    const lagOf = (frame: number) => (due - frame + frameCount) % frameCount;
    const step = this.#due === undefined ? Infinity : lagOf(this.#due);
    this.#maxLag = step > this.#limit ? 0 : Math.min(this.#limit, this.#maxLag + step);
    this.#due = due;
    let best: number | undefined;
    for (const frame of this.#ready.keys())
      if (lagOf(frame) <= this.#maxLag && (best === undefined || lagOf(frame) < lagOf(best))) best = frame;
    if (best === undefined) return undefined;
    const isNews = displayed === undefined || lagOf(best) < lagOf(displayed) || lagOf(displayed) > this.#limit;
    if (!isNews) return undefined;
    const frame = this.#ready.get(best);
    this.#ready.delete(best);
    return frame;
  }

  /** Decodes what is missing of `due`, unless it is displayed, and of the frames after it. */
  decode(due: number, displayed: number | undefined): void {
    const { frameCount } = this.#options.index;
    const ahead = Array.from({ length: Math.min(this.#limit, frameCount) }, (_, n) => (due + n) % frameCount);
    for (const frame of this.#ready.keys()) if (!ahead.includes(frame)) this.#ready.delete(frame);
    const missing = ahead.find((frame) => frame !== displayed && !this.#ready.has(frame));
    if (this.#isBusy || missing === undefined) return;
    const file = fileOfFrame(this.#options.index, missing);
    const frames = this.#options.framesOf(file);
    if (frames === undefined || frames.length === 0) return;
    const upcoming = new Set(ahead.filter((frame) => frame >= missing));
    void this.#run(file, frames, missing, upcoming);
  }

  /** Forgets all frames, and what is being decoded: they would be decoded to another form now. */
  clear(): void {
    this.#aborter.abort();
    this.#aborter = new AbortController();
    this.#isBusy = false;
    this.#ready.clear();
    this.#last = undefined;
  }

  /** Decodes a frame and the upcoming ones behind it in its file. */
  async #run(
    file: number,
    frames: readonly PackedFrame[],
    missing: number,
    upcoming: ReadonlySet<number>,
  ): Promise<void> {
    const { runJob, form, onFrames, onError } = this.#options;
    const { signal } = this.#aborter;
    const first = frames[0]?.number ?? 0;
    const target = missing - first;
    let start = target;
    while (start > 0 && frames[start]?.isDifference === true && this.#last?.number !== first + start - 1) start -= 1;
    let end = target + 1;
    while (end < frames.length && upcoming.has(first + end)) end += 1;
    const isContinued = frames[start]?.isDifference === true;
    this.#isBusy = true;
    try {
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
      for (const frame of decoded.frames) this.#ready.set(frame.header.number, frame);
      this.#last = { number: first + end - 1, components: decoded.last };
    } catch (error) {
      if (signal.aborted) return;
      onError(file, error);
    } finally {
      if (!signal.aborted) this.#isBusy = false;
    }
    onFrames();
  }
}
