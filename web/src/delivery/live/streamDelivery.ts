// The delivery of a live stream. When the stream has stated its lattice and its vertices, a delivery of its static
// files begins, to which the stream is one more file; frames then change the vertices of the delivered stage. An epoch
// of other vertices or another lattice gets a delivery of its own, which replaces the one before when it is whole.

import type { GeometryDescription, Playback } from "../../document/description.ts";
import { isSameDescription } from "../../decode/frame/frameDescription.ts";
import type { BudgetRequest } from "../../scheduler/budget.ts";
import { pause } from "../../scheduler/pause.ts";
import { asDeliveryError } from "../deliveryError.ts";
import { streamFilesOf } from "../encodings/live/liveDelivery.ts";
import type { Delivery, DeliveryListener, FilePriority } from "../geometryDelivery.ts";
import type { Transfer } from "../progress.ts";
import type { ResourcePool } from "../resourcePool.ts";
import { FrameDelivery } from "./frameDelivery.ts";
import { FrameSource } from "./frameSource.ts";
import type { DecodedFrame } from "./frameTarget.ts";
import { isPageHidden, onPageVisibility } from "./pageVisibility.ts";
import type { StreamState } from "./streamState.ts";

/** Requests nothing before `request` is called. Never calls the listener before it returns. */
export function deliverStream(geometry: GeometryDescription, pool: ResourcePool, listener: DeliveryListener): Delivery {
  return new StreamDelivery(geometry, pool, listener);
}

class StreamDelivery implements Delivery {
  readonly #geometry: GeometryDescription;
  readonly #pool: ResourcePool;
  readonly #listener: DeliveryListener;
  readonly #source: FrameSource;
  readonly #transfer: Transfer;
  #displayed: FrameDelivery | undefined;
  /** The newest epoch, which is not displayed yet. */
  #next: FrameDelivery | undefined;
  #priorityOf: FilePriority = () => undefined;
  /** Whether the shape is visible. */
  #isNeeded = false;
  /** Whether shaders read images exactly; undefined while this is not known. */
  #readsTextures: boolean | undefined;
  #isPaused = false;
  #isCancelled = false;
  readonly #stopListening = onPageVisibility(() => {
    this.#followNeeds();
  });

  constructor(geometry: GeometryDescription, pool: ResourcePool, listener: DeliveryListener) {
    this.#geometry = geometry;
    this.#pool = pool;
    this.#listener = listener;
    const url = geometry.patches[0]?.coord[0]?.url ?? "";
    this.#transfer = { url, state: "waiting", loadedBytes: 0, totalBytes: 0, tries: 0, error: undefined };
    this.#source = new FrameSource(
      {
        url: pool.resolve(url),
        fetch: pool.fetch,
        decode: (bytes, signal) => this.#decode(bytes, signal),
        now: () => performance.now(),
        delay: pause,
      },
      {
        onEpoch: (state) => {
          this.#onEpoch(state);
        },
        onFrame: (frame, _, byteLength) => {
          this.#onFrame(frame, byteLength);
        },
        onOutage: (error) => {
          this.#onOutage(error);
        },
      },
    );
  }

  get transfers(): readonly Readonly<Transfer>[] {
    const others = this.#newest?.delivery.transfers ?? [];
    const transfers = others.includes(this.#transfer) ? others : [this.#transfer, ...others];
    return this.#transfer.tries === 0 ? [] : transfers;
  }

  /** Before its first frame a stream that cannot be reached counts as a file that has failed. */
  get isSettled(): boolean {
    if (this.#transfer.state === "failed" || this.#transfer.tries === 0) return true;
    return this.#newest?.delivery.isSettled ?? false;
  }

  /** Never: `request` tells the stream whether it is visible. */
  readonly isExhausted = false;
  readonly followsView = true;

  get storedBytes(): number {
    return (this.#displayed?.delivery.storedBytes ?? 0) + (this.#next?.delivery.storedBytes ?? 0);
  }

  budgetRequests(priorityOf: FilePriority): readonly (readonly BudgetRequest[])[] {
    return this.#newest?.delivery.budgetRequests(priorityOf) ?? [];
  }

  request(priorityOf: FilePriority, granted?: ReadonlySet<BudgetRequest>): void {
    this.#priorityOf = priorityOf;
    const [file] = this.#geometry.patches.flatMap(streamFilesOf);
    this.#isNeeded = file !== undefined && priorityOf(0, file) !== undefined;
    if (this.#isNeeded && this.#transfer.tries === 0) {
      this.#transfer.tries = 1;
      this.#transfer.state = "loading";
      void this.#prepare();
    }
    this.#followNeeds();
    this.#newest?.delivery.request(priorityOf, granted);
  }

  setPlayback({ paused, rate }: Playback): void {
    this.#isPaused = paused;
    this.#source.setRate(Math.max(0, rate));
    this.#followNeeds();
  }

  cancel(): void {
    this.#isCancelled = true;
    this.#stopListening();
    this.#source.stop();
    for (const epoch of [this.#displayed, this.#next]) epoch?.close();
  }

  get #newest(): FrameDelivery | undefined {
    return this.#next ?? this.#displayed;
  }

  /** Frames are requested while shape and page are visible; if not, or if it is paused, until one is displayed. */
  #followNeeds(): void {
    const isReady = this.#readsTextures !== undefined && !this.#isCancelled;
    const isResting = this.#isPaused || isPageHidden();
    const isRunning = isReady && this.#isNeeded && !(isResting && this.#displayed !== undefined);
    if (isRunning) this.#source.start();
    else this.#source.stop();
  }

  async #prepare(): Promise<void> {
    this.#readsTextures = await this.#pool.readsTextures();
    this.#followNeeds();
  }

  /** A frame of the newest epoch. */
  #decode(bytes: Uint8Array<ArrayBuffer>, signal: AbortSignal): Promise<DecodedFrame> {
    const epoch = this.#newest;
    if (epoch === undefined) throw new RangeError("a frame before its epoch");
    return epoch.target.decode(bytes, signal);
  }

  #onEpoch(state: StreamState): void {
    // A publisher that was started again goes on in the same GPU objects.
    if (this.#newest && isSameDescription(this.#newest.description, state)) return;
    this.#next?.close();
    const options = {
      geometry: this.#geometry,
      description: state,
      readsTextures: this.#readsTextures === true,
      pool: this.#pool,
      transfer: this.#transfer,
    };
    const epoch = new FrameDelivery(options, {
      onStage: () => {
        if (epoch === this.#displayed) this.#listener.onStage(0, epoch.stage, epoch.geometry);
        else this.#displayWhole();
      },
      onError: (error) => {
        this.#listener.onError(error);
      },
      onSettled: () => {
        this.#displayWhole();
        if (epoch === this.#newest) this.#listener.onSettled();
      },
    });
    this.#next = epoch;
    epoch.delivery.request(this.#priorityOf);
  }

  #onFrame(frame: DecodedFrame, byteLength: number): void {
    const epoch = this.#newest;
    if (epoch === undefined) return;
    if (this.#transfer.state !== "ready") {
      this.#transfer.loadedBytes = this.#transfer.totalBytes = byteLength;
      this.#transfer.state = "ready";
      this.#transfer.error = undefined;
    }
    epoch.display(frame);
    if (epoch === this.#displayed) this.#reportFrame(epoch);
  }

  #reportFrame(epoch: FrameDelivery): void {
    if (epoch.frame !== undefined) this.#listener.onFrame?.(epoch.frame);
    epoch.frame = undefined;
  }

  /** The picture stays as it is. */
  #onOutage(error: Error): void {
    this.#listener.onError(asDeliveryError(error, this.#transfer.url));
    if (this.#displayed !== undefined) return;
    this.#transfer.state = "failed";
    this.#transfer.error = error.message;
    this.#listener.onSettled();
  }

  /** Displays the newest epoch if all its files have arrived, or if none is displayed. */
  #displayWhole(): void {
    const epoch = this.#next;
    if (epoch?.stage === undefined || (this.#displayed !== undefined && !epoch.delivery.isSettled)) return;
    const before = this.#displayed;
    this.#displayed = epoch;
    this.#next = undefined;
    if (before !== undefined) {
      this.#listener.onSwap?.();
      before.close();
    }
    this.#listener.onStage(0, epoch.stage, epoch.geometry);
    this.#reportFrame(epoch);
    this.#followNeeds();
  }
}
