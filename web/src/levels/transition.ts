// Moves from one cut to another: opens, closes and frees groups one at a time, so that the open set is legal and memory
// within its budget after each step, and tells which groups to request.

import type { LevelIndex } from "./levelIndex.ts";

/** `free`: the group leaves the GPU. Its parents draw other ranges after `open` and `close`. */
export interface LevelStep {
  readonly kind: "open" | "close" | "free";
  readonly group: number;
}

/** The groups of one mesh that are on the GPU, and which of them are open. */
export class ResidentGroups {
  readonly #index: LevelIndex;
  readonly #open = new Set<number>();
  /** GPU memory by group; closed groups in the order in which they were seen last. */
  readonly #memory = new Map<number, number>();
  /** By open group that is not in the target: the time in milliseconds since when. */
  readonly #surplusSince = new Map<number, number>();
  #bytes = 0;

  constructor(index: LevelIndex) {
    this.#index = index;
  }

  /** A legal set, or empty. */
  get open(): ReadonlySet<number> {
    return this.#open;
  }
  /** GPU memory of all groups. */
  get bytes(): number {
    return this.#bytes;
  }
  has(group: number): boolean {
    return this.#memory.has(group);
  }

  /** Adds a group that is on the GPU from now on, closed. */
  add(group: number, memory: number): void {
    if (this.has(group)) throw new Error(`group ${group} is on the GPU already`);
    this.#memory.set(group, memory);
    this.#bytes += memory;
  }

  /**
   * Opens, from the top down, the groups of the target that are here and whose parents are open, and closes those that
   * have not been in the target for `closingDelay` milliseconds. `now` is in milliseconds. Each step has been taken when
   * it is returned; the steps of one call are meant for one frame.
   */
  approach(target: ReadonlySet<number>, now: number, closingDelay: number): LevelStep[] {
    const steps: LevelStep[] = [];
    for (const group of [...this.#surplusSince.keys()]) if (target.has(group)) this.#surplusSince.delete(group);
    for (const group of this.#surplus(target)) {
      const since = this.#surplusSince.get(group) ?? now;
      this.#surplusSince.set(group, since);
      if (now - since >= closingDelay && !this.#hasOpenChild(group)) steps.push(this.#close(group));
    }
    for (const group of target) {
      if (this.#open.has(group) || !this.has(group) || !this.#canOpen(group)) continue;
      this.#open.add(group);
      steps.push({ kind: "open", group });
    }
    return steps;
  }

  /**
   * Frees at least `bytes` of GPU memory, as far as groups outside of the target hold it: closed groups first, the
   * longest unseen before the others, then open ones from the bottom up.
   */
  makeRoom(bytes: number, target: ReadonlySet<number>): LevelStep[] {
    const steps: LevelStep[] = [];
    const goal = this.#bytes - bytes;
    for (const group of [...this.#memory.keys()]) {
      if (this.#bytes <= goal) return steps;
      if (!target.has(group) && !this.#open.has(group)) steps.push(this.#free(group));
    }
    for (const group of this.#surplus(target)) {
      if (this.#bytes <= goal) return steps;
      steps.push(this.#close(group), this.#free(group));
    }
    return steps;
  }

  /** Open groups outside of the target, children before parents. As the target is legal, it has no group below them. */
  #surplus(target: ReadonlySet<number>): number[] {
    return [...this.#open].filter((group) => !target.has(group)).sort((a, b) => b - a);
  }

  #canOpen(group: number): boolean {
    if (group < this.#index.rootCount) return true;
    if (this.#index.missingPages(group).length > 0) return false;
    return this.#index.parents(group).every((parent) => this.#open.has(parent));
  }

  #hasOpenChild(group: number): boolean {
    return this.#index.children(group).some((child) => this.#open.has(child));
  }

  #close(group: number): LevelStep {
    this.#open.delete(group);
    this.#surplusSince.delete(group);
    const memory = this.#memory.get(group) ?? 0;
    this.#memory.delete(group); // and to the end: seen just now
    this.#memory.set(group, memory);
    return { kind: "close", group };
  }

  #free(group: number): LevelStep {
    this.#bytes -= this.#memory.get(group) ?? 0;
    this.#memory.delete(group);
    return { kind: "free", group };
  }
}

export interface RequestChanges {
  /** Groups to request, in order of priority. */
  readonly request: readonly number[];
  /** Groups that are requested and no longer needed. */
  readonly withdraw: readonly number[];
}

/**
 * The requests that lead to the target: of groups whose parents are open or on the way, in the target's order, at most
 * `maxPending` at a time. `pending`: groups that are requested and not yet in `resident`.
 */
export function requestChanges(
  index: LevelIndex,
  target: ReadonlySet<number>,
  resident: Pick<ResidentGroups, "has">,
  pending: ReadonlySet<number>,
  maxPending: number,
): RequestChanges {
  const withdraw = [...pending].filter((group) => !target.has(group));
  const request: number[] = [];
  const isOnTheWay = (group: number) => resident.has(group) || pending.has(group) || request.includes(group);
  for (const group of target) {
    if (pending.size - withdraw.length + request.length >= maxPending) break;
    if (!isOnTheWay(group) && index.parents(group).every(isOnTheWay)) request.push(group);
  }
  return { request, withdraw };
}
