// The delivery of a sequence (docs/formats/sequence.md). The document's own files, which are its first frame, are
// delivered as those of any geometry. The frames that are due replace them when the index and the first of these have
// arrived; while one is missing the last one stays.

import type { SequenceIndex } from "../../decode/sequence/sequenceIndex.ts";
import { readSequenceIndex } from "../../decode/sequence/sequenceIndex.ts";
import type { GeometryDescription, SequenceDescription } from "../../document/description.ts";
import type { BudgetRequest } from "../../scheduler/budget.ts";
import type { Stage } from "../../stage/stage.ts";
import { asDeliveryError } from "../deliveryError.ts";
import type { Delivery, DeliveryListener, FilePriority } from "../geometryDelivery.ts";
import { deliverGeometry } from "../geometryDelivery.ts";
import type { PlayedDelivery, SequencePosition } from "../lateDeliveries.ts";
import type { Transfer } from "../progress.ts";
import type { ResourceHandle, ResourcePool } from "../resourcePool.ts";
import { PlayedFrames } from "./playedFrames.ts";
import { durationOf, frameAt } from "./sequencePosition.ts";

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
  /** The frames, when the index has arrived. */
  #frames: PlayedFrames | undefined;
  /** Whether frames have replaced the document's own files. */
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
      ...(this.#frames?.delivery.transfers ?? []),
    ]);
    return Array.from(transfers);
  }

  get isSettled(): boolean {
    const areFramesSettled =
      this.#hasFailed || this.#indexHandle === undefined || (this.#isDisplayed && this.#frames?.isWhole === true);
    return areFramesSettled && (this.#static?.isSettled ?? true);
  }

  /** Never: `request` tells the sequence whether it is visible. */
  readonly isExhausted = false;
  readonly followsView = true;

  get storedBytes(): number {
    return (this.#static?.storedBytes ?? 0) + (this.#frames?.delivery.storedBytes ?? 0);
  }

  budgetRequests(priorityOf: FilePriority): readonly (readonly BudgetRequest[])[] {
    return (this.#frames?.delivery ?? this.#static)?.budgetRequests(priorityOf) ?? [];
  }

  request(priorityOf: FilePriority, granted?: ReadonlySet<BudgetRequest>): void {
    this.#priorityOf = priorityOf;
    this.#static?.request(priorityOf, this.#frames ? undefined : granted);
    this.#frames?.delivery.request(priorityOf, granted);
    const priority = this.#priority;
    if (priority !== undefined && this.#indexHandle === undefined) this.#requestIndex(priority);
    this.#indexHandle?.setPriority(priority ?? 0);
    this.#follow();
  }

  /** Seconds; 0 before the index has arrived. */
  get duration(): number {
    return this.#frames === undefined ? 0 : durationOf(this.#frames.index);
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
    this.#frames?.close();
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
    const [geometry, sequence, pool] = [this.#geometry, this.#sequence, this.#pool];
    this.#frames = new PlayedFrames(
      { geometry, sequence, index, readsTextures, pool, transfer },
      {
        onStage: () => {
          this.#displayFrames();
        },
        onFrame: () => {
          if (!this.#isDisplayed) this.#displayFrames();
          this.#reportFrame();
        },
        onError: (error, url) => {
          this.#listener.onError(asDeliveryError(error, url));
        },
        onSettled: () => {
          if (!this.#isDisplayed) this.#displayFrames();
          this.#settle();
        },
      },
    );
    this.#frames.delivery.request(this.#priorityOf);
    this.#follow();
  }

  /** Tells the frames which one is due. */
  #follow(): void {
    const frames = this.#frames;
    if (frames === undefined || this.#isCancelled) return;
    const priority = this.#priority;
    if (priority === undefined) frames.rest();
    else frames.follow(frameAt(this.#position, frames.index), priority);
  }

  /**
   * Displays the stage of the frames, when all its files have arrived; the first frame of the document stays until
   * then. Later frames change its vertices.
   */
  #displayFrames(): void {
    const frames = this.#frames;
    if (frames?.stage === undefined) return;
    const isFirst = !this.#isDisplayed;
    if (isFirst && this.#staticStage !== undefined && !frames.isWhole) return;
    this.#isDisplayed = true;
    this.#listener.onStage(0, frames.stage, frames.geometry);
    if (!isFirst) return;
    this.#static?.cancel();
    this.#static = undefined;
    this.#reportFrame();
    this.#settle();
  }

  #reportFrame(): void {
    const frame = this.#isDisplayed ? this.#frames?.takeFrame() : undefined;
    if (frame) this.#listener.onFrame?.(frame);
  }

  #settle(): void {
    if (this.isSettled) this.#listener.onSettled();
  }
}
