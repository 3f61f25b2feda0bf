// The lossless video of a sequence (docs/formats/video.md): its file, and runs of its frames. It is of use only where
// the browser decodes such videos exactly; every frame has a checksum besides.

import { DecodeError } from "../../decode/decodeError.ts";
import type { FrameForm } from "../../decode/sequence/sequenceFrames.ts";
import type { SequenceIndex } from "../../decode/sequence/sequenceIndex.ts";
import { videoSizeOf } from "../../decode/video/videoFrame.ts";
import { readWebm } from "../../decode/video/webm.ts";
import type { ResourceHandle, ResourcePool } from "../resourcePool.ts";
import type { FrameRuns, SequenceFrame } from "./frameRuns.ts";
import { decodesVideosExactly } from "./videoSelfTest.ts";
import { VideoRuns } from "./videoRuns.ts";

export interface SequenceVideoListener {
  /** Frames can be decoded. */
  onFile(): void;
  /** The video cannot be played. `error`: undefined where the browser cannot decode any such video exactly. */
  onUnusable(error: unknown): void;
}

/** Requests nothing before `follow` is called. */
export class SequenceVideo implements FrameRuns {
  readonly url: string;
  readonly #index: SequenceIndex;
  readonly #pool: ResourcePool;
  readonly #form: () => FrameForm;
  readonly #listener: SequenceVideoListener;
  #isExact: Promise<boolean> | undefined;
  #priority: number | undefined;
  #handle: ResourceHandle | undefined;
  #runs: VideoRuns | undefined;
  #isClosed = false;

  constructor(
    url: string,
    index: SequenceIndex,
    pool: ResourcePool,
    form: () => FrameForm,
    listener: SequenceVideoListener,
  ) {
    this.url = url;
    this.#index = index;
    this.#pool = pool;
    this.#form = form;
    this.#listener = listener;
  }

  /** Requests the file. */
  follow(priority: number): void {
    this.#priority = priority;
    this.#handle?.setPriority(priority);
    if (this.#isExact !== undefined) return;
    this.#isExact = decodesVideosExactly();
    void this.#isExact.then((isExact) => {
      if (this.#isClosed) return;
      if (!isExact) this.#listener.onUnusable(undefined);
      else if (this.#priority !== undefined) this.#request();
    });
  }

  /** Nobody sees the frames. What has been loaded stays. */
  rest(): void {
    this.#priority = undefined;
    if (this.#runs === undefined) this.#release();
    this.#isExact = this.#runs && this.#isExact;
  }

  decode(
    frame: number,
    upcoming: ReadonlySet<number>,
    signal: AbortSignal,
  ): Promise<readonly SequenceFrame[]> | undefined {
    return this.#runs?.decode(frame, upcoming, signal);
  }

  reset(): void {
    this.#runs?.reset();
  }

  /** The video is not used again. `error`: what is wrong with it. */
  fail(error: unknown): void {
    if (error !== undefined) this.#handle?.fail(error);
    this.close();
  }

  close(): void {
    this.#isClosed = true;
    this.#runs?.reset();
    this.#release();
  }

  #release(): void {
    this.#handle?.release();
    this.#handle = undefined;
  }

  #request(): void {
    const handle = this.#pool.acquire({
      kind: "bytes",
      url: this.url,
      priority: this.#priority ?? 0,
      expectedBytes: this.#index.files.reduce((sum, { bytes }) => sum + bytes, 0),
    });
    this.#handle = handle;
    void this.#receive(handle);
  }

  async #receive(handle: ResourceHandle): Promise<void> {
    try {
      const content = await handle.content;
      if (this.#handle !== handle || content.kind !== "bytes") return;
      this.#runs = this.#read(content.bytes);
    } catch (error) {
      if (this.#handle === handle) this.#listener.onUnusable(error);
      return;
    } finally {
      handle.finish();
    }
    this.#listener.onFile();
  }

  /** Throws DecodeError. */
  #read(bytes: Uint8Array<ArrayBuffer>): VideoRuns {
    const index = this.#index;
    const { width, height, packets } = readWebm(bytes);
    const size = videoSizeOf(index);
    if (width !== size.width || height !== size.height)
      throw new DecodeError(
        "malformed",
        `has images of ${width} x ${height} pixels; those of its frames have ${size.width} x ${size.height}`,
      );
    if (packets.length !== index.frameCount)
      throw new DecodeError("malformed", `has ${packets.length} images; its index states ${index.frameCount} frames`);
    const { runJob } = this.#pool;
    return new VideoRuns({
      size,
      packets,
      toFrame: (pixels, number, signal) =>
        runJob("videoFrame", { pixels, layout: index, rate: index.rate, number, form: this.#form() }, signal),
    });
  }
}
