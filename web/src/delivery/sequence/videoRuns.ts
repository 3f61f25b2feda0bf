// Runs of frames in a lossless video, decoded by the browser (WebCodecs). Its decoder keeps its state, so that a run
// goes on where the one before has ended; any other begins at the packet before it that stands alone.

import { DecodeError } from "../../decode/decodeError.ts";
import type { VideoPixels, VideoSize } from "../../decode/video/videoFrame.ts";
import type { VideoPacket } from "../../decode/video/webm.ts";
import type { FrameRuns, SequenceFrame } from "./frameRuns.ts";

/** VP9, profile 1, eight bits: RGB. */
export const videoCodec = "vp09.01.62.08.03.01.13.00.01";

/** Without a frame for so long the decoder is taken for broken. */
const maxSilenceMilliseconds = 10_000;
/** Timestamps are integers of microseconds. */
const timestampStep = 1000;

export interface VideoRunsOptions {
  readonly size: VideoSize;
  readonly packets: readonly VideoPacket[];
  /** The vertices that the pixels of an image are. Rejects with DecodeError. */
  readonly toFrame: (pixels: VideoPixels, number: number, signal: AbortSignal) => Promise<SequenceFrame>;
}

interface Waiting extends Pick<PromiseWithResolvers<SequenceFrame>, "resolve" | "reject"> {
  readonly signal: AbortSignal;
}

export class VideoRuns implements FrameRuns {
  readonly #options: VideoRunsOptions;
  #decoder: VideoDecoder | undefined;
  /** The packet that the decoder can go on with. */
  #next: number | undefined;
  /** Frames that are being decoded, by their numbers. */
  readonly #waiting = new Map<number, Waiting>();

  constructor(options: VideoRunsOptions) {
    this.#options = options;
  }

  async decode(frame: number, upcoming: ReadonlySet<number>, signal: AbortSignal): Promise<readonly SequenceFrame[]> {
    const { packets } = this.#options;
    let start = frame;
    while (start > 0 && start !== this.#next && packets[start]?.isKey !== true) start -= 1;
    let end = frame + 1;
    while (end < packets.length && upcoming.has(end)) end += 1;
    const decoder = (this.#decoder ??= this.#makeDecoder());
    const frames: Promise<SequenceFrame>[] = [];
    for (let number = start; number < end; ++number) {
      const packet = packets[number];
      if (packet === undefined) break;
      if (number >= frame) {
        const { promise, ...settle } = Promise.withResolvers<SequenceFrame>();
        this.#waiting.set(number, { ...settle, signal });
        frames.push(promise);
      }
      const type = packet.isKey ? "key" : "delta";
      decoder.decode(new EncodedVideoChunk({ type, timestamp: number * timestampStep, data: packet.bytes }));
    }
    this.#next = end;
    const silence = setTimeout(() => {
      this.#fail(new DecodeError("unsupported", `is not decoded by this browser: frame ${frame} does not come`));
    }, maxSilenceMilliseconds);
    try {
      return await Promise.all(frames);
    } finally {
      clearTimeout(silence);
    }
  }

  reset(): void {
    this.#fail(new DOMException("", "AbortError"));
  }

  #makeDecoder(): VideoDecoder {
    const decoder: VideoDecoder = new VideoDecoder({
      output: (image) => {
        if (decoder === this.#decoder) void this.#receive(image);
        else image.close();
      },
      error: (error) => {
        if (decoder === this.#decoder) this.#fail(new DecodeError("malformed", `cannot be decoded: ${error.message}`));
      },
    });
    decoder.configure(decoderConfigOf(this.#options.size));
    return decoder;
  }

  async #receive(image: VideoFrame): Promise<void> {
    const number = Math.round(image.timestamp / timestampStep);
    const waiting = this.#waiting.get(number);
    this.#waiting.delete(number);
    try {
      if (waiting === undefined) return;
      const pixels = await pixelsOf(image, this.#options.size);
      image.close(); // its memory is the decoder's
      waiting.resolve(await this.#options.toFrame(pixels, number, waiting.signal));
    } catch (error) {
      waiting?.reject(error);
    } finally {
      image.close();
    }
  }

  /** Ends all that is being decoded. The next run begins anew. */
  #fail(error: unknown): void {
    const decoder = this.#decoder;
    this.#decoder = undefined;
    this.#next = undefined;
    for (const { reject } of this.#waiting.values()) reject(error);
    this.#waiting.clear();
    if (decoder !== undefined && decoder.state !== "closed") decoder.close();
  }
}

export function decoderConfigOf({ width, height }: VideoSize): VideoDecoderConfig {
  return {
    codec: videoCodec,
    codedWidth: width,
    codedHeight: height,
    // What the packets themselves state; without it some decoders assume others.
    colorSpace: { primaries: "bt709", transfer: "iec61966-2-1", matrix: "rgb", fullRange: true },
    // Each packet gives its image at once, not when others have followed.
    optimizeForLatency: true,
    hardwareAcceleration: "prefer-software",
  };
}

/** The bytes of an image, without a conversion of its colours. Rejects with DecodeError for another size or format. */
async function pixelsOf(image: VideoFrame, { width, height }: VideoSize): Promise<VideoPixels> {
  const { format, visibleRect } = image;
  if (visibleRect?.width !== width || visibleRect.height !== height)
    throw new DecodeError("malformed", "has images of another size than it states");
  const bytes = new Uint8Array(image.allocationSize());
  const planes = await image.copyTo(bytes);
  const offsets = planes.map(({ offset }) => offset);
  const strides = planes.map(({ stride }) => stride);
  const [first = 0, second = 0, third = 0] = offsets;
  const [stride = 0, secondStride = 0, thirdStride = 0] = strides;
  switch (format) {
    case "I444": // green, blue, red
      return {
        bytes,
        offsets: [third, first, second],
        strides: [thirdStride, stride, secondStride],
        step: 1,
      };
    case "RGBA":
    case "RGBX":
      return { bytes, offsets: [first, first + 1, first + 2], strides: [stride, stride, stride], step: 4 };
    case "BGRA":
    case "BGRX":
      return { bytes, offsets: [first + 2, first + 1, first], strides: [stride, stride, stride], step: 4 };
    default:
      throw new DecodeError("unsupported", `is decoded to ${format ?? "a format"} that has other colours`);
  }
}
