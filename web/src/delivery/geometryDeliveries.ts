// One delivery for each geometry, however many shapes show it: a geometry that
// is USEd is downloaded, decoded and stored once.

import type { Stage } from "../stage/stage.ts";
import type { GeometryDescription } from "../document/description.ts";
import type { Delivery, DeliveryListener, FilePriority } from "./geometryDelivery.ts";
import { deliverGeometry } from "./geometryDelivery.ts";
import type { DeliveryError } from "./deliveryError.ts";
import type { Transfer } from "./progress.ts";
import type { ResourcePool } from "./resourcePool.ts";
import type { BudgetRequest } from "../scheduler/budget.ts";

/** What one of those who share a delivery sees of it. */
export type JoinedDelivery = Pick<Delivery, "transfers" | "isSettled" | "isExhausted" | "cancel">;

interface Shared {
  readonly delivery: Delivery;
  /** Those who have joined, and those of them who have been told what came before. */
  members: number;
  readonly listeners: Set<DeliveryListener>;
  /** What has been told so far, for those who join late. */
  readonly stages: Map<number, Stage>;
  readonly errors: DeliveryError[];
}

export class GeometryDeliveries {
  readonly #pool: ResourcePool;
  readonly #shared = new Map<GeometryDescription, Shared>();

  constructor(pool: ResourcePool) {
    this.#pool = pool;
  }

  /**
   * The geometry's stages as they come; what has come already follows in the next
   * microtask. Never calls the listener before it returns. The last one to cancel
   * ends the delivery.
   */
  join(geometry: GeometryDescription, listener: DeliveryListener): JoinedDelivery {
    const shared = this.#shared.get(geometry) ?? this.#start(geometry);
    const { delivery } = shared;
    let isCancelled = false;
    shared.members += 1;
    queueMicrotask(() => {
      if (isCancelled) return;
      shared.listeners.add(listener);
      for (const [patch, stage] of shared.stages) listener.onStage(patch, stage);
      for (const error of shared.errors) listener.onError(error);
      if (delivery.isSettled) listener.onSettled();
    });
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
      cancel: () => {
        if (isCancelled) return;
        isCancelled = true;
        shared.listeners.delete(listener);
        shared.members -= 1;
        if (shared.members > 0) return;
        this.#shared.delete(geometry);
        delivery.cancel();
      },
    };
  }

  /** What all of them would take on the GPU, as far as is known; what several share counts for each. */
  get storedBytes(): number {
    let bytes = 0;
    for (const { delivery } of this.#shared.values()) bytes += delivery.storedBytes;
    return bytes;
  }

  /** Of all files that were asked for, each once. */
  transfers(): Readonly<Transfer>[] {
    const all = new Set<Readonly<Transfer>>();
    for (const { delivery } of this.#shared.values()) for (const transfer of delivery.transfers) all.add(transfer);
    return Array.from(all);
  }

  /** What they want, and have, of the GPU. */
  budgetRequests(demandOf: (geometry: GeometryDescription) => FilePriority): readonly (readonly BudgetRequest[])[] {
    return Array.from(this.#shared).flatMap(([geometry, { delivery }]) => delivery.budgetRequests(demandOf(geometry)));
  }

  /** Says what is wanted of each geometry, for all who show it; of claims what is granted, and the rest is given up. */
  request(demandOf: (geometry: GeometryDescription) => FilePriority, granted?: ReadonlySet<BudgetRequest>): void {
    for (const [geometry, { delivery }] of this.#shared) {
      if (granted !== undefined || !delivery.isExhausted) delivery.request(demandOf(geometry), granted);
    }
  }

  #start(geometry: GeometryDescription): Shared {
    const listeners = new Set<DeliveryListener>();
    const stages = new Map<number, Stage>();
    const errors: DeliveryError[] = [];
    const delivery = deliverGeometry(geometry, this.#pool, {
      onStage(patch, stage) {
        if (stage === undefined) stages.delete(patch);
        else stages.set(patch, stage);
        for (const listener of listeners) listener.onStage(patch, stage);
      },
      onError(error) {
        errors.push(error);
        for (const listener of listeners) listener.onError(error);
      },
      onSettled() {
        for (const listener of listeners) listener.onSettled();
      },
    });
    const shared: Shared = { delivery, members: 0, listeners, stages, errors };
    this.#shared.set(geometry, shared);
    return shared;
  }
}
