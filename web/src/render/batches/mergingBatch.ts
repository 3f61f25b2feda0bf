// What batches that merge their members into one geometry have in common.

import type { Frustum } from "three";
import type { Batch, BatchResources, Member, MergedGeometry, Run } from "./batch.ts";

export abstract class MergingBatch<Merged extends MergedGeometry> implements Batch {
  protected readonly resources: BatchResources;
  protected readonly merged: Merged;
  /** Whether the members differ from those that three.js draws. */
  protected hasChanged = true;

  constructor(resources: BatchResources, merged: Merged) {
    this.resources = resources;
    this.merged = merged;
  }

  abstract invalidateBounds(): void;
  abstract update(frustum: Frustum): void;
  abstract drawRuns(runs: readonly Run[]): void;
  abstract dispose(): void;

  get isEmpty(): boolean {
    return this.merged.isEmpty;
  }

  hasRoomFor(member: Member): boolean {
    return this.merged.hasRoomFor(member);
  }

  add(member: Member): void {
    this.merged.add(member);
    this.hasChanged = true;
  }

  remove(member: Member): void {
    this.merged.remove(member);
    this.hasChanged = true;
  }
}
