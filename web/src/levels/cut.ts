// Chooses the groups to be open: a cut through the graphs of all meshes by the errors on the screen, under one budget of
// GPU memory. What the budget cannot hold is not in the cut, and so is never requested.

import type { LevelIndex } from "./levelIndex.ts";
import type { ErrorInPixels } from "./projectedError.ts";

/** Groups are opened above this error, in pixels of the canvas. */
export const tolerance = 1;

/** Groups of larger errors are requested first, up to this factor. */
export const maxErrorFactor = 64;

/** The factor of the priority of a group with this error in pixels. */
export function errorFactorOf(error: number): number {
  return Math.min(maxErrorFactor, Math.max(1, error / tolerance));
}

/** An open group is closed below this part of the tolerance, so that small movements change nothing. */
export const closingRatio = 0.7;

export interface CutMesh {
  readonly index: LevelIndex;
  readonly errorInPixels: ErrorInPixels;
  /** The groups that are open now: empty, or a legal set. */
  readonly open: ReadonlySet<number>;
  /** Groups whose files do not come: neither they nor groups below are in the cut. */
  readonly absent: ReadonlySet<number>;
  /** GPU memory of a group's vertex. */
  readonly bytesPerVertex: number;
}

export interface CutOptions {
  /** Error in pixels above which groups are opened. */
  readonly tolerance: number;
  /** GPU memory in bytes for the groups of all meshes. Roots are in the cut even if it does not hold them. */
  readonly budget: number;
}

export interface MeshCut {
  /** A legal set; groups in the order in which they entered, parents before their children. */
  readonly target: ReadonlySet<number>;
  /** Pages of the index that are needed to refine further, in order of need. */
  readonly missingPages: ReadonlySet<number>;
}

export interface Cut {
  /** For each mesh. */
  readonly meshes: readonly MeshCut[];
  /** GPU memory of all groups of the cut. */
  readonly bytes: number;
}

/** GPU memory of a group: its vertices, and its indices of 16 or 32 bits. */
export function groupMemory(
  { index, bytesPerVertex }: Pick<CutMesh, "index" | "bytesPerVertex">,
  group: number,
): number {
  return index.vertices(group) * bytesPerVertex + indexMemory(index, group) + chipMemory(index, group);
}

export function indexMemory(index: LevelIndex, group: number): number {
  return 3 * index.triangles(group) * (index.vertices(group) > 65536 ? 4 : 2);
}

/** GPU memory of a group's image with its mipmaps, which take a third more. */
export function chipMemory(index: LevelIndex, group: number): number {
  const [columns, rows] = index.chipSize(group);
  return (4 / 3) * 4 * columns * rows;
}

/**
 * Greedy: from the roots down, the group of the largest error next, until all errors are within the tolerance or the
 * next group exceeds the budget. Every prefix is legal. A group counts for 1 / `closingRatio` of its error while it is
 * open; as parents of open groups are open, errors still nest. For the same view, cuts that are chosen again while
 * groups open and close only grow, so that they reach a fixed point.
 *
 * Takes time for the groups of the cut and their children alone.
 */
export function chooseCut(meshes: readonly CutMesh[], { tolerance, budget }: CutOptions): Cut {
  const targets = meshes.map(() => new Set<number>());
  const pages = meshes.map(() => new Set<number>());
  const heap = new CandidateHeap();
  let bytes = 0;

  const addChildren = (number: number, mesh: CutMesh, target: ReadonlySet<number>, group: number): void => {
    const { index, absent, open } = mesh;
    for (const child of index.children(group)) {
      const missing = index.missingPages(child);
      for (const page of missing) pages[number]!.add(page);
      if (missing.length > 0 || !includesAll(target, index.parents(child))) continue;
      const error = mesh.errorInPixels(child);
      const key = open.has(child) ? error / closingRatio : error;
      if (key > tolerance && !absent.has(child)) heap.push({ mesh: number, group: child, key });
    }
  };
  const add = (number: number, group: number): void => {
    targets[number]!.add(group);
    addChildren(number, meshes[number]!, targets[number]!, group);
  };

  for (const [number, mesh] of meshes.entries())
    for (let root = 0; root < mesh.index.rootCount; ++root) {
      for (const page of mesh.index.missingPages(root)) pages[number]!.add(page);
      if (!mesh.index.has(root)) continue;
      bytes += groupMemory(mesh, root);
      add(number, root);
    }
  for (let next = heap.first; next !== undefined; next = heap.first) {
    const memory = groupMemory(meshes[next.mesh]!, next.group);
    if (bytes + memory > budget) break;
    heap.pop();
    bytes += memory;
    add(next.mesh, next.group);
  }
  return { meshes: targets.map((target, number) => ({ target, missingPages: pages[number]! })), bytes };
}

function includesAll(set: ReadonlySet<number>, groups: readonly number[]): boolean {
  for (const group of groups) if (!set.has(group)) return false;
  return true;
}

interface Candidate {
  readonly mesh: number;
  readonly group: number;
  /** Its error, larger while the group is open. */
  readonly key: number;
}

/** A binary heap of plain records: `PriorityQueue` of the scheduler keeps entries that can be removed, which costs more. */
class CandidateHeap {
  readonly #items: Candidate[] = [];

  get first(): Candidate | undefined {
    return this.#items[0];
  }

  push(item: Candidate): void {
    const items = this.#items;
    let at = items.push(item) - 1;
    while (at > 0) {
      const above = (at - 1) >> 1;
      if (!isBefore(item, items[above]!)) break;
      items[at] = items[above]!;
      at = above;
    }
    items[at] = item;
  }

  pop(): void {
    const items = this.#items;
    const item = items.pop();
    if (item === undefined || items.length === 0) return;
    let at = 0;
    for (let below = 1; below < items.length; below = 2 * at + 1) {
      if (below + 1 < items.length && isBefore(items[below + 1]!, items[below]!)) ++below;
      if (!isBefore(items[below]!, item)) break;
      items[at] = items[below]!;
      at = below;
    }
    items[at] = item;
  }
}

/** Equal errors: the lower number first, so that the cut does not depend on the order of insertion. */
function isBefore(a: Candidate, b: Candidate): boolean {
  if (a.key !== b.key) return a.key > b.key;
  return a.mesh === b.mesh ? a.group < b.group : a.mesh < b.mesh;
}
