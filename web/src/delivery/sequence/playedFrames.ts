// Plays the frames of a sequence whose index has arrived: requests and decodes them ahead, and displays the one that is
// due. They come from a video where there is one that the browser decodes exactly, otherwise from the sequence's files.

import type { SequenceIndex } from "../../decode/sequence/sequenceIndex.ts";
import { fileOfFrame } from "../../decode/sequence/sequenceIndex.ts";
import type { GeometryDescription, SequenceDescription } from "../../document/description.ts";
import type { Stage } from "../../stage/stage.ts";
import type { Delivery, LiveFrame } from "../geometryDelivery.ts";
import { FrameDelivery } from "../live/frameDelivery.ts";
import { ArrayTarget } from "../live/liveArrays.ts";
import { ImageTarget } from "../live/liveImages.ts";
import type { Transfer } from "../progress.ts";
import type { ResourcePool } from "../resourcePool.ts";
import type { SequenceFrame } from "./frameRuns.ts";
import { FramesAhead } from "./framesAhead.ts";
import { frameDescriptionOf, framesGeometryOf } from "./framesGeometry.ts";
import { PackedRuns } from "./packedRuns.ts";
import { SequenceFiles } from "./sequenceFiles.ts";
import { SequenceVideo } from "./sequenceVideo.ts";

export interface PlayedFramesOptions {
  /** The document's geometry. */
  readonly geometry: GeometryDescription;
  readonly sequence: SequenceDescription;
  readonly index: SequenceIndex;
  /** Whether shaders read images exactly. */
  readonly readsTextures: boolean;
  readonly pool: ResourcePool;
  /** That of the index. */
  readonly transfer: Readonly<Transfer>;
}

export interface PlayedFramesListener {
  /** `stage` has changed. */
  onStage(): void;
  /** A frame has replaced the vertices. */
  onFrame(): void;
  onError(error: unknown, url: string): void;
  onSettled(): void;
}

export class PlayedFrames {
  readonly index: SequenceIndex;
  readonly #listener: PlayedFramesListener;
  readonly #frames: FrameDelivery;
  readonly #files: SequenceFiles;
  readonly #packedRuns: PackedRuns;
  /** Where frames come from, until it turns out not to be exact. */
  #video: SequenceVideo | undefined;
  readonly #ahead: FramesAhead;
  #due: number | undefined;
  #priority = 0;
  #displayed: number | undefined;
  /** Resolved when a frame has been displayed in the present form. */
  #again: PromiseWithResolvers<void> | undefined;

  constructor(options: PlayedFramesOptions, listener: PlayedFramesListener) {
    const { geometry, sequence, index, readsTextures, pool, transfer } = options;
    this.index = index;
    this.#listener = listener;
    this.#frames = new FrameDelivery(
      {
        geometry: framesGeometryOf(geometry, sequence.url),
        description: frameDescriptionOf(geometry, index),
        readsTextures,
        pool,
        transfer,
        decodeAgain: () => this.#decodeAgain(),
      },
      {
        onStage: () => {
          listener.onStage();
        },
        onError: (error) => {
          listener.onError(error, error.url);
        },
        onSettled: () => {
          listener.onSettled();
        },
      },
    );
    const urlOf = (file: number) => new URL(index.files[file]?.url ?? "", pool.resolve(sequence.url)).href;
    const onFile = () => {
      this.#advance();
    };
    this.#files = new SequenceFiles(index, urlOf, pool, {
      onFile,
      onError: (error, url) => {
        listener.onError(error, url);
      },
    });
    const form = () => this.#frames.target.form;
    const framesOf = (file: number) => this.#files.framesOf(file);
    this.#packedRuns = new PackedRuns({ index, framesOf, runJob: pool.runJob, form });
    if (sequence.video !== undefined)
      this.#video = new SequenceVideo(sequence.video, index, pool, form, {
        onFile,
        onUnusable: (error) => {
          this.#leaveVideo(error);
        },
      });
    this.#ahead = new FramesAhead({
      index,
      runs: this.#video ?? this.#packedRuns,
      onFrames: () => {
        this.#advance();
      },
      onError: (frame, error) => {
        if (this.#video) this.#leaveVideo(error);
        else this.#files.fail(fileOfFrame(index, frame), error);
      },
    });
  }

  get delivery(): Delivery {
    return this.#frames.delivery;
  }

  /** With frames as its coordinates. */
  get geometry(): GeometryDescription {
    return this.#frames.geometry;
  }

  get stage(): Stage | undefined {
    return this.#frames.stage;
  }

  /** Whether the stage can be displayed, and all its files have arrived. */
  get isWhole(): boolean {
    return this.stage !== undefined && this.delivery.isSettled;
  }

  /** The displayed frame, once. */
  takeFrame(): LiveFrame | undefined {
    const { frame } = this.#frames;
    this.#frames.frame = undefined;
    return frame;
  }

  /** The frame with this number is due. */
  follow(due: number, priority: number): void {
    this.#due = due;
    this.#priority = priority;
    this.#request(due);
    this.#advance();
  }

  /** Nobody sees the frames. */
  rest(): void {
    this.#due = undefined;
    this.#video?.rest();
    this.#files.clear();
  }

  close(): void {
    this.#again?.reject(new DOMException("", "AbortError"));
    this.#ahead.clear();
    this.#video?.close();
    this.#files.clear();
    this.#frames.close();
  }

  #request(due: number): void {
    if (this.#video) this.#video.follow(this.#priority);
    else this.#files.follow(fileOfFrame(this.index, due), this.#priority);
  }

  /** Displays the frame that is due, or the newest one before it, as far as they are decoded; decodes the next ones. */
  #advance(): void {
    const due = this.#due;
    if (due === undefined) return;
    const frame = this.#ahead.take(due, this.#displayed);
    if (frame !== undefined) this.#display(frame);
    this.#ahead.decode(due, this.#displayed);
  }

  #display(frame: SequenceFrame): void {
    const { header } = frame;
    this.#displayed = header.number;
    this.#frames.display({
      header,
      display: () => {
        this.#write(frame);
      },
    });
    this.#again?.resolve();
    this.#again = undefined;
    this.#listener.onFrame();
  }

  #write(frame: SequenceFrame): void {
    const { target } = this.#frames;
    if (target instanceof ImageTarget && "width" in frame) target.write(frame);
    else if (target instanceof ArrayTarget && !("width" in frame)) target.write(frame);
  }

  /** Goes on with the files of the frames. `error`: what is wrong with the video; undefined: it was not requested. */
  #leaveVideo(error: unknown): void {
    const video = this.#video;
    if (video === undefined) return;
    this.#video = undefined;
    this.#ahead.goOnWith(this.#packedRuns);
    video.fail(error);
    if (error !== undefined) this.#listener.onError(error, video.url);
    if (this.#due !== undefined) this.#request(this.#due);
  }

  /** Frames are decoded to another form from now on. Resolves when one has been displayed. */
  #decodeAgain(): Promise<void> {
    this.#ahead.clear();
    if (this.#displayed === undefined) return Promise.resolve();
    this.#displayed = undefined;
    this.#again ??= Promise.withResolvers();
    const { promise } = this.#again;
    this.#advance();
    return promise;
  }
}
