// The decoded frames of a sequence: the one that is due and a few after it, which are decoded ahead.

import { unpackedBytesOf } from "../../decode/frame/frameHeader.ts";
import type { SequenceIndex } from "../../decode/sequence/sequenceIndex.ts";
import type { FrameRuns, SequenceFrame } from "./frameRuns.ts";

/** Decoded frames that wait: at most so many, of so many bytes, but always two. */
const maxFramesAhead = 8;
const maxBytesAhead = 16 * 2 ** 20;

export interface FramesAheadOptions {
  readonly index: SequenceIndex;
  readonly runs: FrameRuns;
  /** Further frames have been decoded. */
  readonly onFrames: () => void;
  /** A frame cannot be decoded, or one that is decoded with it. */
  readonly onError: (frame: number, error: unknown) => void;
}

export class FramesAhead {
  readonly #options: FramesAheadOptions;
  readonly #limit: number;
  readonly #ready = new Map<number, SequenceFrame>();
  #runs: FrameRuns;
  /** The frame that was due last, and how many frames before it have been due since the last jump. */
  #due: number | undefined;
  #maxLag = 0;
  #aborter = new AbortController();
  #isBusy = false;

  constructor(options: FramesAheadOptions) {
    this.#options = options;
    this.#runs = options.runs;
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
    const upcoming = new Set(ahead.filter((frame) => frame >= missing));
    const decoding = this.#runs.decode(missing, upcoming, this.#aborter.signal);
    if (decoding !== undefined) void this.#receive(missing, decoding, this.#aborter.signal);
  }

  /** Frames come from elsewhere from now on. Those that are decoded stay. */
  goOnWith(runs: FrameRuns): void {
    this.#abort();
    this.#runs = runs;
  }

  /** Forgets all frames, and what is being decoded: they would be decoded to another form now. */
  clear(): void {
    this.#abort();
    this.#ready.clear();
  }

  #abort(): void {
    this.#aborter.abort();
    this.#aborter = new AbortController();
    this.#isBusy = false;
    this.#runs.reset();
  }

  async #receive(missing: number, decoding: Promise<readonly SequenceFrame[]>, signal: AbortSignal): Promise<void> {
    const { onFrames, onError } = this.#options;
    this.#isBusy = true;
    try {
      const frames = await decoding;
      if (signal.aborted) return;
      this.#isBusy = false;
      for (const frame of frames) this.#ready.set(frame.header.number, frame);
    } catch (error) {
      if (signal.aborted) return;
      this.#isBusy = false;
      onError(missing, error);
    }
    onFrames();
  }
}
