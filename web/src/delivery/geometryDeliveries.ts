// The deliveries of all geometries, one each: a geometry that several shapes USE is downloaded, decoded and stored
// once.

import type { Stage } from "../stage/stage.ts";
import type { GeometryDescription, Playback } from "../document/description.ts";
import type { GeometryView, LevelStatistics } from "./geometryView.ts";
import type { Delivery, DeliveryListener, FilePriority } from "./geometryDelivery.ts";
import { deliverGeometry } from "./geometryDelivery.ts";
import type { PlayedDelivery, SequencePosition } from "./lateDeliveries.ts";
import { lateDelivery } from "./lateDeliveries.ts";
import type { DeliveryError } from "./deliveryError.ts";
import { Members } from "./members.ts";
import type { Transfer } from "./progress.ts";
import type { ResourcePool } from "./resourcePool.ts";
import type { BudgetRequest } from "../scheduler/budget.ts";

/** A shared delivery as one of its members has joined it. */
export type JoinedDelivery = Pick<Delivery, "transfers" | "isSettled" | "isExhausted" | "cancel"> & {
  setPlayback(playback: Playback): void;
  /** Requests its files with the priorities of the last `request` of all deliveries. */
  request(): void;
  /** A shape shows it until `next` has loaded: its files now have the priorities of those of `next`, too. */
  leadTo(next: GeometryDescription): void;
};

interface SharedDelivery {
  readonly delivery: Delivery;
  /** The same, where it is the delivery of a sequence. */
  readonly played: PlayedDelivery | undefined;
  readonly members: Members<DeliveryListener>;
  /** The present stages and all errors, for members that join later. */
  readonly stages: Map<number, readonly [stage: Stage, drawn: GeometryDescription | undefined]>;
  readonly errors: DeliveryError[];
  /** What a member's shape shows after this geometry. */
  next: GeometryDescription | undefined;
}

export class GeometryDeliveries {
  readonly #pool: ResourcePool;
  readonly #shared = new Map<GeometryDescription, SharedDelivery>();
  #priorityOf: (geometry: GeometryDescription) => FilePriority = () => () => undefined;
  /** The last fraction of each interpolator of a sequence. */
  readonly #fractions = new Map<number, number>();
  #sequenceTime: number | undefined;
  #startedCount = 0;

  constructor(pool: ResourcePool) {
    this.#pool = pool;
  }

  /**
   * Reports the geometry's stages as they are built, and those that have been built in the next microtask. Never
   * calls the listener before it returns. The delivery ends when its last member cancels.
   */
  join(geometry: GeometryDescription, listener: DeliveryListener): JoinedDelivery {
    const shared = this.#shared.get(geometry) ?? this.#start(geometry);
    const { delivery } = shared;
    const cancel = shared.members.join(
      listener,
      () => {
        for (const [patch, [stage, drawn]] of shared.stages) listener.onStage(patch, stage, drawn);
        for (const error of shared.errors) listener.onError(error);
        if (delivery.isSettled) listener.onSettled();
      },
      () => {
        this.#shared.delete(geometry);
        delivery.cancel();
      },
    );
    return {
      get transfers() {
        return delivery.transfers;
      },
      get isSettled() {
        return delivery.isSettled;
      },
      get isExhausted() {
        return delivery.isExhausted;
      },
      setPlayback(playback) {
        delivery.setPlayback?.(playback);
      },
      request: () => {
        delivery.request(priorityWithin(this.#priorityOf, geometry, shared));
      },
      leadTo(next) {
        shared.next = next;
      },
      cancel,
    };
  }

  /** How many deliveries have ever been started. */
  get startedCount(): number {
    return this.#startedCount;
  }

  /** Whether the view decides about files that have not been loaded. */
  get followView(): boolean {
    for (const { delivery } of this.#shared.values()) if (delivery.followsView) return true;
    return false;
  }

  /** Estimated bytes of all geometries on the GPU; files that several share count for each. */
  get storedBytes(): number {
    let bytes = 0;
    for (const { delivery } of this.#shared.values()) bytes += delivery.storedBytes;
    return bytes;
  }

  /** The transfers of all requested files, each once. */
  transfers(): Readonly<Transfer>[] {
    const all = new Set<Readonly<Transfer>>();
    for (const { delivery } of this.#shared.values()) for (const transfer of delivery.transfers) all.add(transfer);
    return Array.from(all);
  }

  /** The GPU memory that the geometries require or hold. */
  budgetRequests(priorityOf: (geometry: GeometryDescription) => FilePriority): readonly (readonly BudgetRequest[])[] {
    return Array.from(this.#shared).flatMap(([geometry, shared]) =>
      shared.delivery.budgetRequests(priorityWithin(priorityOf, geometry, shared)),
    );
  }

  /**
   * Tells geometries with levels of detail how they are seen. `maxBytes`: the GPU memory of all geometries, of which
   * those with levels share what the others leave. Call it before `request`.
   */
  followViews(viewOf: (geometry: GeometryDescription) => GeometryView, maxBytes: number): void {
    const followers = Array.from(this.#shared).filter(([, { delivery }]) => delivery.followView !== undefined);
    if (followers.length === 0) return;
    let otherBytes = 0;
    for (const { delivery } of this.#shared.values())
      if (delivery.followView === undefined) otherBytes += delivery.storedBytes;
    const sharedBytes = Math.max(0, maxBytes - otherBytes);
    for (const [geometry, { delivery }] of followers) delivery.followView?.(viewOf(geometry), sharedBytes, this);
  }

  /** That of all meshes with levels of detail together. */
  get levelStatistics(): LevelStatistics {
    const sum = { groups: 0, openGroups: 0, bytes: 0, errorInPixels: 0 };
    for (const { delivery } of this.#shared.values()) {
      const own = delivery.levelStatistics?.();
      if (!own) continue;
      sum.groups += own.groups;
      sum.openGroups += own.openGroups;
      sum.bytes += own.bytes;
      sum.errorInPixels = Math.max(sum.errorInPixels, own.errorInPixels);
    }
    return sum;
  }

  /** An interpolator of a sequence has received a fraction, 0 … 1. */
  setFraction(interpolator: number, fraction: number): void {
    this.#fractions.set(interpolator, fraction);
    this.#updatePositions();
  }

  /** Makes all sequences display the frame at this time, in seconds; undefined: they follow their interpolators. */
  setSequenceTime(seconds: number | undefined): void {
    this.#sequenceTime = seconds;
    this.#updatePositions();
  }

  /** The duration of the longest sequence whose index has arrived, in seconds; 0 where there is none. */
  get sequenceDuration(): number {
    let longest = 0;
    for (const { played } of this.#shared.values()) longest = Math.max(longest, played?.duration ?? 0);
    return longest;
  }

  /** The duration of the sequence of an interpolator, in seconds; 0 before its index has arrived. */
  sequenceDurationOf(interpolator: number): number {
    for (const [{ sequence }, { played }] of this.#shared)
      if (sequence?.interpolator === interpolator && played) return played.duration;
    return 0;
  }

  /** Updates the priorities of all files. If `granted` is given, budget requests that are not in it are evicted. */
  request(priorityOf: (geometry: GeometryDescription) => FilePriority, granted?: ReadonlySet<BudgetRequest>): void {
    this.#priorityOf = priorityOf;
    for (const [geometry, shared] of this.#shared) {
      const { delivery } = shared;
      if (granted !== undefined || !delivery.isExhausted)
        delivery.request(priorityWithin(priorityOf, geometry, shared), granted);
    }
  }

  #deliver(geometry: GeometryDescription, listener: DeliveryListener): Delivery {
    const { moving, levels } = geometry;
    if (moving) return lateDelivery("moving")(geometry, moving, this.#pool, listener);
    if (levels) return lateDelivery("levels")(geometry, levels, this.#pool, listener);
    const deliver = geometry.encoding === "live" ? lateDelivery("stream") : deliverGeometry;
    return deliver(geometry, this.#pool, listener);
  }

  /** The delivery of a sequence; undefined for other geometry. */
  #play(geometry: GeometryDescription, listener: DeliveryListener): PlayedDelivery | undefined {
    const { moving, sequence } = geometry;
    if (moving !== undefined || sequence === undefined) return undefined;
    const played = lateDelivery("sequence")(geometry, sequence, this.#pool, listener);
    played.setPosition(this.#positionOf(sequence.interpolator));
    return played;
  }

  #start(geometry: GeometryDescription): SharedDelivery {
    const members = new Members<DeliveryListener>();
    const stages: SharedDelivery["stages"] = new Map();
    const errors: DeliveryError[] = [];
    const membersListener: DeliveryListener = {
      onStage(patch, stage, drawn) {
        if (stage === undefined) stages.delete(patch);
        else stages.set(patch, [stage, drawn]);
        for (const listener of members) listener.onStage(patch, stage, drawn);
      },
      onSwap() {
        for (const listener of members) listener.onSwap?.();
      },
      onFrame(frame) {
        for (const listener of members) listener.onFrame?.(frame);
      },
      onError(error) {
        errors.push(error);
        for (const listener of members) listener.onError(error);
      },
      onSettled() {
        for (const listener of members) listener.onSettled();
      },
    };
    const played = this.#play(geometry, membersListener);
    const delivery = played ?? this.#deliver(geometry, membersListener);
    const shared: SharedDelivery = { delivery, played, members, stages, errors, next: undefined };
    this.#shared.set(geometry, shared);
    this.#startedCount += 1;
    return shared;
  }

  #positionOf(interpolator: number): SequencePosition {
    return this.#sequenceTime === undefined
      ? { fraction: this.#fractions.get(interpolator) ?? 0 }
      : { seconds: this.#sequenceTime };
  }

  #updatePositions(): void {
    for (const [{ sequence }, { played }] of this.#shared)
      if (sequence) played?.setPosition(this.#positionOf(sequence.interpolator));
  }
}

/** The priorities of a geometry's files; those of the next geometry where the document no longer has this one. */
function priorityWithin(
  priorityOf: (geometry: GeometryDescription) => FilePriority,
  geometry: GeometryDescription,
  { next }: SharedDelivery,
): FilePriority {
  const own = priorityOf(geometry);
  const ofNext = next && priorityOf(next);
  return ofNext ? (patch, file) => own(patch, file) ?? ofNext(patch, file) : own;
}
