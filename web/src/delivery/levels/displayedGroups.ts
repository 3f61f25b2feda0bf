// The groups of a mesh with levels of detail that are on the GPU, and what is displayed of them: a stage for each open
// group, which is a patch of the geometry by its number. The open groups are a legal cut after each call, so that what
// they display is closed.

import type { GeometryDescription, PatchDescription } from "../../document/description.ts";
import { chipMemory, indexMemory } from "../../levels/cut.ts";
import type { LevelIndex } from "../../levels/levelIndex.ts";
import { expectedBytesPerVertex } from "../../levels/meshMemory.ts";
import type { ErrorInPixels } from "../../levels/projectedError.ts";
import type { LevelStep } from "../../levels/transition.ts";
import { ResidentGroups } from "../../levels/transition.ts";
import type { LevelStatistics } from "../geometryView.ts";
import type { DeliveryListener } from "../geometryDelivery.ts";
import type { StoredGroup } from "./storedGroup.ts";
import { groupPatch } from "./storedGroup.ts";

export class DisplayedGroups {
  readonly index: LevelIndex;
  readonly #geometry: GeometryDescription;
  /** The whole mesh as a patch. */
  readonly #whole: PatchDescription;
  /** By group that has been on the GPU. */
  readonly #patches: PatchDescription[];
  readonly #resident: ResidentGroups;
  /** The groups of `#resident`. */
  readonly #stored = new Map<number, Pick<StoredGroup, "byteLength" | "stage" | "close">>();
  readonly #listener: Pick<DeliveryListener, "onStage">;
  /** Whether a view has had all that it needs. */
  #isComplete = false;

  /** `whole`: the patch of `geometry`. `listener` gets the geometry with a patch for each group. */
  constructor(
    geometry: GeometryDescription,
    whole: PatchDescription,
    index: LevelIndex,
    listener: Pick<DeliveryListener, "onStage">,
  ) {
    this.#whole = whole;
    this.#patches = [whole];
    this.#geometry = { ...geometry, patches: this.#patches };
    this.index = index;
    this.#resident = new ResidentGroups(index);
    this.#listener = listener;
  }

  /** A legal cut, or empty. */
  get open(): ReadonlySet<number> {
    return this.#resident.open;
  }

  /** GPU memory of all groups. */
  get bytes(): number {
    return this.#resident.bytes;
  }

  /** GPU memory of a vertex of any group: all have the same attributes. */
  get bytesPerVertex(): number {
    const { index } = this;
    for (const [group, { byteLength }] of this.#stored)
      return (byteLength - indexMemory(index, group)) / index.vertices(group);
    return expectedBytesPerVertex;
  }

  has(group: number): boolean {
    return this.#resident.has(group);
  }

  statistics(errorInPixels: ErrorInPixels): LevelStatistics {
    return {
      groups: this.#stored.size,
      openGroups: this.open.size,
      bytes: this.bytes,
      errorInPixels: Math.max(0, ...Array.from(this.open, (group) => this.#drawnErrorOf(group, errorInPixels))),
    };
  }

  /** Adds a group, closed, with the memory of its image. */
  add(group: number, stored: Pick<StoredGroup, "byteLength" | "stage" | "close">): void {
    this.#patches[group] = groupPatch(this.#geometry, this.#whole, this.index, group);
    this.#stored.set(group, stored);
    this.#resident.add(group, stored.byteLength + chipMemory(this.index, group));
  }

  /** Opens what is here of the target, and closes what has not been in it for `closingDelay`; `now` likewise in ms. */
  approach(target: ReadonlySet<number>, now: number, closingDelay: number): void {
    this.#display(this.#resident.approach(target, now, closingDelay));
  }

  /** Frees at least `bytes` as far as groups that are not `needed` have them, and returns these groups. */
  makeRoom(bytes: number, needed: ReadonlySet<number>): readonly number[] {
    const steps = this.#resident.makeRoom(bytes, needed);
    this.#display(steps); // before groups are freed that stages have drawn
    const freed = steps.filter(({ kind }) => kind === "free").map(({ group }) => group);
    for (const group of freed) {
      this.#stored.get(group)?.close();
      this.#stored.delete(group);
    }
    return freed;
  }

  /** A view has all that it needs: from now on the root is no base of what follows. */
  complete(): void {
    if (this.#isComplete) return;
    this.#isComplete = true;
    this.#displayGroup(0);
  }

  /** Frees everything. No stage may be drawn any more, and no other method be called. */
  close(): void {
    for (const stored of this.#stored.values()) stored.close();
    this.#stored.clear();
  }

  /** A group that opens or closes draws itself or nothing, and its parents other parts of themselves. */
  #display(steps: readonly LevelStep[]): void {
    const changed = new Set<number>();
    for (const { kind, group } of steps) {
      if (kind === "free") continue;
      changed.add(group);
      for (const parent of this.index.parents(group)) changed.add(parent);
    }
    for (const group of changed) this.#displayGroup(group);
  }

  #displayGroup(group: number): void {
    const stored = this.open.has(group) ? this.#stored.get(group) : undefined;
    const name = group > 0 || this.#isComplete ? "full" : "base";
    const children = Array.from(this.index.children(group));
    const bounds = { x: 0, y: 0, z: 0, radius: 0, reach: 0, error: 0 };
    const errorOf = (child: number): number => {
      this.index.readBounds(this.#withKnownError(child, group), bounds);
      return bounds.error;
    };
    const stage = stored?.stage(name, children, this.open, errorOf, errorOf(group));
    this.#listener.onStage(group, stage, this.#geometry);
  }

  /** The largest error of the coarse forms that an open group draws: those of its closed children. */
  #drawnErrorOf(group: number, errorInPixels: ErrorInPixels): number {
    const closed = Array.from(this.index.children(group)).filter((child) => !this.open.has(child));
    return Math.max(0, ...closed.map((child) => errorInPixels(this.#withKnownError(child, group))));
  }

  /** The child, or its parent, whose error is at least as large, where the child is on a page that is not here. */
  #withKnownError(child: number, parent: number): number {
    return this.index.has(child) ? child : parent;
  }
}
