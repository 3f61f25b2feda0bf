// The delivery of a sequence (docs/formats/sequence.md). The document's own files, which are its first frame, are
// delivered as those of any geometry. The frames that are due replace them when the index and the first of these have
// arrived; while one is missing the last one stays.

import type { FrameDescription } from "../../decode/frame/frameDescription.ts";
import type { SequenceIndex } from "../../decode/sequence/sequenceIndex.ts";
import { fileOfFrame, readSequenceIndex } from "../../decode/sequence/sequenceIndex.ts";
import type { GeometryDescription, SequenceDescription } from "../../document/description.ts";
import type { BudgetRequest } from "../../scheduler/budget.ts";
import type { Stage } from "../../stage/stage.ts";
import { asDeliveryError } from "../deliveryError.ts";
import type { Delivery, DeliveryListener, FilePriority } from "../geometryDelivery.ts";
import { deliverGeometry } from "../geometryDelivery.ts";
import { FrameDelivery } from "../live/frameDelivery.ts";
import { ArrayTarget } from "../live/liveArrays.ts";
import { ImageTarget } from "../live/liveImages.ts";
import type { Transfer } from "../progress.ts";
import type { ResourceHandle, ResourcePool } from "../resourcePool.ts";
import type { PlayedDelivery, SequencePosition } from "../lateDeliveries.ts";
import { FramesAhead } from "./framesAhead.ts";
import type { SequenceFrame } from "./frameRuns.ts";
import { PackedRuns } from "./packedRuns.ts";
import { SequenceFiles } from "./sequenceFiles.ts";
import { SequenceVideo } from "./sequenceVideo.ts";

const indexBytes = 4096;

/** Requests nothing before `request` is called. Never calls the listener before it returns. */
export class SequenceDelivery implements PlayedDelivery {
  readonly #geometry: GeometryDescription;
  readonly #sequence: SequenceDescription;
  readonly #pool: ResourcePool;
  readonly #listener: DeliveryListener;
  /** The document's own files, until frames replace them. */
  #static: Delivery | undefined;
  #staticStage: Stage | undefined;
  #indexHandle: ResourceHandle | undefined;
  #hasFailed = false;
  #playing: Playing | undefined;
  #isDisplayed = false;
  #position: SequencePosition = { fraction: 0 };
  #priorityOf: FilePriority = () => undefined;
  #isCancelled = false;

  constructor(
    geometry: GeometryDescription,
    sequence: SequenceDescription,
    pool: ResourcePool,
    listener: DeliveryListener,
  ) {
    this.#geometry = geometry;
    this.#sequence = sequence;
    this.#pool = pool;
    this.#listener = listener;
    this.#static = deliverGeometry(geometry, pool, {
      onStage: (patch, stage) => {
        this.#staticStage = stage;
        if (!this.#isDisplayed) listener.onStage(patch, stage);
      },
      onError: (error) => {
        listener.onError(error);
      },
      onSettled: () => {
        this.#settle();
      },
    });
  }

  get transfers(): readonly Readonly<Transfer>[] {
    const transfers = new Set([
      ...(this.#static?.transfers ?? []),
      ...(this.#indexHandle ? [this.#indexHandle.transfer] : []),
      ...(this.#playing?.delivery.transfers ?? []),
    ]);
    return Array.from(transfers);
  }

  get isSettled(): boolean {
    const areFramesSettled =
      this.#hasFailed || this.#indexHandle === undefined || (this.#isDisplayed && this.#isWhole(this.#playing));
    return areFramesSettled && (this.#static?.isSettled ?? true);
  }

  /** Never: `request` tells the sequence whether it is visible. */
  readonly isExhausted = false;
  readonly followsView = true;

  get storedBytes(): number {
    return (this.#static?.storedBytes ?? 0) + (this.#playing?.delivery.storedBytes ?? 0);
  }

  budgetRequests(priorityOf: FilePriority): readonly (readonly BudgetRequest[])[] {
    return (this.#playing?.delivery ?? this.#static)?.budgetRequests(priorityOf) ?? [];
  }

  request(priorityOf: FilePriority, granted?: ReadonlySet<BudgetRequest>): void {
    this.#priorityOf = priorityOf;
    this.#static?.request(priorityOf, this.#playing ? undefined : granted);
    this.#playing?.delivery.request(priorityOf, granted);
    const priority = this.#priority;
    if (priority !== undefined && this.#indexHandle === undefined) this.#requestIndex(priority);
    this.#indexHandle?.setPriority(priority ?? 0);
    this.#follow();
  }

  /** Seconds; 0 before the index has arrived. */
  get duration(): number {
    const index = this.#playing?.index;
    return index === undefined ? 0 : index.frameCount / index.rate;
  }

  /** The frame at this position is due. */
  setPosition(position: SequencePosition): void {
    this.#position = position;
    this.#follow();
  }

  cancel(): void {
    this.#isCancelled = true;
    this.#static?.cancel();
    this.#indexHandle?.release();
    this.#playing?.close();
  }

  /** That of the first coordinates; undefined: the shape is not visible. */
  get #priority(): number | undefined {
    const [reference] = this.#geometry.patches[0]?.coord ?? [];
    if (reference === undefined) return undefined;
    return this.#priorityOf(0, {
      role: "coord",
      plane: 0,
      reference,
      target: { kind: "live" },
      chunk: { type: "coord", plane: 0 },
      expectedBytes: 0,
      storedBytes: 0,
    });
  }

  #requestIndex(priority: number): void {
    const { url } = this.#sequence;
    this.#indexHandle = this.#pool.acquire({ kind: "bytes", url, priority, expectedBytes: indexBytes });
    void this.#receiveIndex(this.#indexHandle);
  }

  async #receiveIndex(handle: ResourceHandle): Promise<void> {
    try {
      const [content, readsTextures] = await Promise.all([handle.content, this.#pool.readsTextures()]);
      if (this.#isCancelled || content.kind !== "bytes") return;
      const index = readSequenceIndex(content.bytes);
      handle.finish();
      this.#play(index, readsTextures, handle.transfer);
    } catch (error) {
      if (this.#isCancelled) return;
      handle.fail(error);
      handle.finish();
      this.#hasFailed = true;
      this.#listener.onError(asDeliveryError(error, this.#sequence.url));
      this.#settle();
    }
  }

  #play(index: SequenceIndex, readsTextures: boolean, transfer: Readonly<Transfer>): void {
    const { url } = this.#sequence;
    const playing = (this.#playing = new Playing({
      index,
      videoUrl: this.#sequence.video,
      geometry: framesGeometryOf(this.#geometry, url),
      urlOf: (file) => new URL(index.files[file]?.url ?? "", this.#pool.resolve(url)).href,
      readsTextures,
      pool: this.#pool,
      transfer,
      onStage: () => {
        this.#displayFrames();
      },
      onFrame: () => {
        if (!this.#isDisplayed) this.#displayFrames();
        this.#reportFrame();
      },
      onError: (error, fileUrl) => {
        this.#listener.onError(asDeliveryError(error, fileUrl));
      },
      onSettled: () => {
        if (!this.#isDisplayed) this.#displayFrames();
        this.#settle();
      },
    }));
    playing.delivery.request(this.#priorityOf);
    this.#follow();
  }

  #follow(): void {
    const playing = this.#playing;
    if (playing === undefined || this.#isCancelled) return;
    const priority = this.#priority;
    if (priority === undefined) playing.rest();
    else playing.follow(frameAt(this.#position, playing.index), priority);
  }

  /** Whether frames can be displayed in place of the document's own files. */
  #isWhole(playing: Playing | undefined): boolean {
    return playing?.stage !== undefined && playing.delivery.isSettled;
  }

  /**
   * Displays the stage of the frames, when all its files have arrived; the first frame of the document stays until
   * then. Later frames change its vertices.
   */
  #displayFrames(): void {
    const playing = this.#playing;
    if (playing?.stage === undefined) return;
    const isFirst = !this.#isDisplayed;
    if (isFirst && this.#staticStage !== undefined && !this.#isWhole(playing)) return;
    this.#isDisplayed = true;
    this.#listener.onStage(0, playing.stage, playing.geometry);
    if (!isFirst) return;
    this.#static?.cancel();
    this.#static = undefined;
    this.#reportFrame();
    this.#settle();
  }

  #reportFrame(): void {
    const frame = this.#isDisplayed ? this.#playing?.takeFrame() : undefined;
    if (frame) this.#listener.onFrame?.(frame);
  }

  #settle(): void {
    if (this.isSettled) this.#listener.onSettled();
  }
}

/** The geometry whose coordinates are frames. */
function framesGeometryOf(geometry: GeometryDescription, url: string): GeometryDescription {
  const patches = geometry.patches.map((patch) => ({ ...patch, coord: [{ url, firstTexel: 0 }], normal: undefined }));
  return { ...geometry, encoding: "live", patches };
}

/** What the frames state, without values where the shape is coloured by another attribute: that one does not change. */
function valuesOf({ value }: GeometryDescription, index: SequenceIndex): FrameDescription {
  return value === undefined || value.name === index.valueName ? index : { ...index, valueComponents: 0 };
}

/** The number of the frame at a position. */
function frameAt(position: SequencePosition, { frameCount, rate }: SequenceIndex): number {
  // Times that are multiples of a frame's duration may lie just before it.
  const tolerance = 1e-6;
  const frames = "seconds" in position ? position.seconds * rate : position.fraction * frameCount;
  return Math.max(0, Math.min(frameCount - 1, Math.floor(frames + tolerance)));
}

interface PlayingOptions {
  readonly index: SequenceIndex;
  /** The address of a video of the same frames. */
  readonly videoUrl: string | undefined;
  readonly geometry: GeometryDescription;
  readonly urlOf: (file: number) => string;
  readonly readsTextures: boolean;
  readonly pool: ResourcePool;
  readonly transfer: Readonly<Transfer>;
  readonly onStage: () => void;
  /** A frame has replaced the vertices. */
  readonly onFrame: () => void;
  readonly onError: (error: unknown, url: string) => void;
  readonly onSettled: () => void;
}

/** The frames of a sequence whose index has arrived. */
class Playing {
  readonly index: SequenceIndex;
  readonly #frames: FrameDelivery;
  readonly #files: SequenceFiles;
  readonly #ahead: FramesAhead;
  /** Where frames come from, until it turns out not to be exact. */
  #video: SequenceVideo | undefined;
  readonly #onFrame: () => void;
  readonly #onError: (error: unknown, url: string) => void;
  #due: number | undefined;
  #priority = 0;
  #displayed: number | undefined;
  /** Resolved when a frame has been displayed in the present form. */
  #again: PromiseWithResolvers<void> | undefined;

  constructor(options: PlayingOptions) {
    const { index, videoUrl, geometry, urlOf, readsTextures, pool, transfer } = options;
    const { onStage, onFrame, onError, onSettled } = options;
    this.index = index;
    this.#onFrame = onFrame;
    this.#onError = onError;
    this.#files = new SequenceFiles(index, urlOf, pool, {
      onFile: () => {
        this.#advance();
      },
      onError,
    });
    this.#frames = new FrameDelivery(
      {
        geometry,
        description: valuesOf(geometry, index),
        readsTextures,
        pool,
        transfer,
        decodeAgain: () => this.#decodeAgain(),
      },
      {
        onStage,
        onError: (error) => {
          onError(error, error.url);
        },
        onSettled,
      },
    );
    const form = () => this.#frames.target.form;
    const runs = new PackedRuns({ index, framesOf: (file) => this.#files.framesOf(file), runJob: pool.runJob, form });
    if (videoUrl !== undefined)
      this.#video = new SequenceVideo(videoUrl, index, pool, form, {
        onFile: () => {
          this.#advance();
        },
        onUnusable: (error) => {
          this.#leaveVideo(runs, error);
        },
      });
    this.#ahead = new FramesAhead({
      index,
      runs: this.#video ?? runs,
      onFrames: () => {
        this.#advance();
      },
      onError: (frame, error) => {
        if (this.#video) this.#leaveVideo(runs, error);
        else this.#files.fail(fileOfFrame(index, frame), error);
      },
    });
  }

  get delivery(): Delivery {
    return this.#frames.delivery;
  }

  get geometry(): GeometryDescription {
    return this.#frames.geometry;
  }

  get stage(): Stage | undefined {
    return this.#frames.stage;
  }

  /** The displayed frame, once. */
  takeFrame(): FrameDelivery["frame"] {
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

  /** Goes on with the files of the same frames. `error`: what is wrong with the video; undefined: it was not requested. */
  #leaveVideo(runs: PackedRuns, error: unknown): void {
    const video = this.#video;
    if (video === undefined) return;
    this.#video = undefined;
    this.#ahead.goOnWith(runs);
    video.fail(error);
    if (error !== undefined) this.#onError(error, video.url);
    if (this.#due !== undefined) this.#request(this.#due);
  }

  #advance(): void {
    const due = this.#due;
    if (due === undefined) return;
    const frame = this.#ahead.take(due, this.#displayed);
    if (frame !== undefined) {
      this.#displayed = frame.header.number;
      const { header } = frame;
      this.#frames.display({
        header,
        display: () => {
          this.#write(frame);
        },
      });
      this.#again?.resolve();
      this.#again = undefined;
      this.#onFrame();
    }
    this.#ahead.decode(due, this.#displayed);
  }

  #write(frame: SequenceFrame): void {
    const { target } = this.#frames;
    if (target instanceof ImageTarget && "width" in frame) target.write(frame);
    else if (target instanceof ArrayTarget && !("width" in frame)) target.write(frame);
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
