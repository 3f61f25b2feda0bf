import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { TestRandom } from "../decode/compact/rangeEncoder.testing.ts";
import { chooseCut, groupMemory } from "./cut.ts";
import { drawRanges } from "./drawRanges.ts";
import type { LevelIndex } from "./levelIndex.ts";
import type { TestMesh } from "./levels.testing.ts";
import { illegalityOf, indexOf, randomMesh } from "./levels.testing.ts";
import { randomView } from "./levelViews.testing.ts";
import type { LevelView } from "./projectedError.ts";
import { errorInPixels } from "./projectedError.ts";
import type { LevelStep } from "./transition.ts";
import { ResidentGroups, requestChanges } from "./transition.ts";

const bytesPerVertex = 12;
const maxPending = 6;

/** A page that loads one mesh: files arrive after some frames, in any order. Checks every step. */
class FakePage {
  readonly mesh: TestMesh;
  readonly index: LevelIndex;
  readonly resident: ResidentGroups;
  readonly pending = new Set<number>();
  readonly absent = new Set<number>();
  readonly requested: number[] = [];
  readonly withdrawn: number[] = [];
  target: ReadonlySet<number> = new Set();
  budget: number;
  now = 0;
  freeCount = 0;
  /** A replay of all steps, to be compared with the state of `resident`. */
  readonly #open = new Set<number>();
  readonly #here = new Set<number>();
  readonly #random: TestRandom;
  readonly #parents: readonly number[][];

  constructor(mesh: TestMesh, budget: number, random: TestRandom) {
    this.mesh = mesh;
    this.index = indexOf(mesh.levels);
    this.resident = new ResidentGroups(this.index);
    this.budget = budget;
    this.#random = random;
    this.#parents = mesh.levels.groups.map((_, group) => [...this.index.parents(group)]);
  }

  memoryOf(group: number): number {
    return groupMemory({ index: this.index, bytesPerVertex }, group);
  }

  frame(view: LevelView, tolerance = 1): void {
    const { index, resident, absent, budget } = this;
    this.now += 100;
    const measure = errorInPixels(index, [view]);
    const mesh = { index, errorInPixels: measure, open: resident.open, absent, bytesPerVertex };
    this.target = chooseCut([mesh], { tolerance, budget }).meshes[0]!.target;
    const { request, withdraw } = requestChanges(index, this.target, resident, this.pending, maxPending);
    for (const group of withdraw) this.pending.delete(group);
    for (const group of request) this.pending.add(group);
    this.requested.push(...request);
    this.withdrawn.push(...withdraw);
    assert.ok(this.pending.size <= maxPending);
    for (const group of this.pending) if (this.#random.below(3) === 0) this.#arrive(group);
    this.#take(resident.approach(this.target, this.now, 1000));
    this.#checkDrawn();
  }

  /** Whether nothing is under way. */
  get isAtRest(): boolean {
    const isOpen = [...this.target].every((group) => this.resident.open.has(group));
    return isOpen && this.resident.open.size === this.target.size && this.pending.size === 0;
  }

  #arrive(group: number): void {
    const memory = this.memoryOf(group);
    const excess = this.resident.bytes + memory - this.budget;
    if (excess > 0) this.#take(this.resident.makeRoom(excess, this.target));
    this.pending.delete(group);
    this.resident.add(group, memory);
    this.#here.add(group);
    this.checkBudget();
  }

  checkBudget(): void {
    assert.ok(this.resident.bytes <= this.budget, `${this.resident.bytes} of ${this.budget} bytes`);
    assert.equal(
      this.resident.bytes,
      [...this.#here].reduce((sum, group) => sum + this.memoryOf(group), 0),
    );
  }

  /** Replays steps, after each of which the open groups are legal and on the GPU. */
  #take(steps: readonly LevelStep[]): void {
    for (const { kind, group } of steps) {
      if (kind === "free") ++this.freeCount;
      const { children } = this.mesh.levels.groups[group]!;
      if (kind === "open") {
        assert.ok(this.#here.has(group) && !this.#open.has(group));
        for (const parent of this.#parents[group]!) assert.ok(this.#open.has(parent), `${parent} above ${group}`);
        this.#open.add(group);
      } else if (kind === "close") {
        for (const child of children) assert.ok(!this.#open.has(child), `${child} below ${group}`);
        assert.ok(this.#open.delete(group));
      } else {
        assert.ok(!this.#open.has(group) && this.#here.delete(group));
      }
    }
    assert.deepEqual(this.#open, new Set(this.resident.open));
  }

  #checkDrawn(): void {
    const { levels, segments, itemCount } = this.mesh;
    const { open } = this.resident;
    assert.equal(illegalityOf(levels, open), undefined);
    if (open.size === 0) return;
    const counts = new Uint8Array(itemCount);
    for (const group of open)
      for (const { first, count } of drawRanges(levels.groups[group]!.children, segments[group]!.segmentStarts, open))
        for (const item of segments[group]!.items.slice(first, first + count)) ++counts[item]!;
    assert.ok(counts.every((count) => count === 1));
  }
}

function makePage(seed: number): { page: FakePage; random: TestRandom } {
  const random = new TestRandom(seed);
  const mesh = randomMesh(seed, 300 + random.below(500), 6 + random.below(8), 8);
  const page = new FakePage(mesh, 0, random);
  const all = mesh.levels.groups.reduce((sum, _, group) => sum + page.memoryOf(group), 0);
  page.budget = Math.floor(page.memoryOf(0) + (all * (5 + random.below(60))) / 100);
  return { page, random };
}

describe("transitions of random meshes with cameras that jump", () => {
  let largest = 0;
  let withdrawals = 0;
  let frees = 0;
  for (let seed = 0; seed < 60; ++seed)
    test(`mesh ${seed} is legal, drawn once and within its budget in every frame, and comes to rest`, () => {
      const { page, random } = makePage(seed);
      const tolerance = 0.02;
      for (let flight = 0; flight < 6; ++flight) {
        for (let n = 0; n < 4; ++n) {
          const view = randomView(random);
          for (let frame = random.below(12); frame >= 0; --frame) page.frame(view, tolerance);
        }
        const view = randomView(random);
        page.frame(view, tolerance);
        withdrawals += page.withdrawn.length;
        largest = Math.max(largest, page.target.size);
        page.withdrawn.length = 0;
        page.requested.length = 0;
        // A smaller group may fit once groups of the last view are closed: rest is a frame after which nothing changes.
        for (let frame = 0, calm = 0; calm < 2; ++frame) {
          assert.ok(frame < 600, "comes to rest");
          page.frame(view, tolerance);
          calm = page.isAtRest ? calm + 1 : 0;
        }
        assert.equal(new Set(page.requested).size, page.requested.length, "nothing is requested twice");
        assert.deepEqual(page.withdrawn, [], "what is requested at rest is needed");
        page.requested.length = 0;
        const open = new Set(page.resident.open);
        for (let frame = 0; frame < 30; ++frame) page.frame(view, tolerance);
        assert.deepEqual([page.requested, new Set(page.resident.open)], [[], open], "and stays there");
      }
      frees += page.freeCount;
    });

  test("open many groups, free many, and withdraw requests", () => {
    assert.ok(largest > 30 && withdrawals > 100 && frees > 500, `${largest}, ${withdrawals}, ${frees}`);
  });
});

test("a budget that shrinks is kept at once", () => {
  const { page, random } = makePage(40);
  page.budget = 1e9;
  const view = randomView(random);
  while (page.target.size === 0 || !page.isAtRest) page.frame(view, 0.05);
  const before = page.resident.bytes;
  const budget = Math.floor(before / 2);
  const measure = errorInPixels(page.index, [view]);
  const { open } = page.resident;
  const mesh = { index: page.index, errorInPixels: measure, open, absent: page.absent, bytesPerVertex };
  const { target } = chooseCut([mesh], { tolerance: 0.05, budget }).meshes[0]!;
  page.resident.makeRoom(before - budget, target);
  assert.ok(page.resident.bytes <= budget && page.resident.bytes > 0);
  assert.equal(illegalityOf(page.mesh.levels, page.resident.open), undefined);
  for (const group of target) assert.ok(page.resident.open.has(group), "the target stays");
});

test("a file that does not come leaves the rest to come to rest", () => {
  const { page, random } = makePage(41);
  page.budget = 1e9;
  const view = randomView(random);
  const first = [...indexOf(page.mesh.levels).children(0)].slice(0, 2);
  for (const group of first) page.absent.add(group);
  for (let frame = 0; frame === 0 || !page.isAtRest; ++frame) {
    assert.ok(frame < 600);
    page.frame(view, 0.01);
  }
  for (const group of first) assert.equal(page.resident.has(group), false);
  assert.ok(page.resident.open.size > 1);
});

test("closed groups stay until there is need; then the longest unseen goes first", () => {
  const { levels } = randomMesh(9, 800, 10);
  const index = indexOf(levels);
  const resident = new ResidentGroups(index);
  const children = [...index.children(0)];
  assert.ok(children.length >= 3);
  const [a, b, c] = children as [number, number, number];
  for (const group of [0, a, b, c]) resident.add(group, 100);
  resident.approach(new Set([0, a, b, c]), 0, 1000);
  assert.equal(resident.open.size, 4);
  assert.deepEqual(resident.approach(new Set([0, a, c]), 10, 1000), []);
  assert.deepEqual(resident.approach(new Set([0, c]), 500, 1000), []);
  assert.deepEqual(resident.approach(new Set([0, c]), 1010, 1000), [{ kind: "close", group: b }]);
  assert.deepEqual(resident.approach(new Set([0, c]), 1500, 1000), [{ kind: "close", group: a }]);
  assert.equal(resident.bytes, 400);
  assert.deepEqual(resident.makeRoom(100, new Set([0, c])), [{ kind: "free", group: b }]);
  assert.deepEqual(resident.approach(new Set([0, a, c]), 1600, 1000), [{ kind: "open", group: a }]);
  // Back in the target, a group's second begins anew.
  assert.deepEqual(resident.approach(new Set([0, c]), 2500, 1000), []);
  assert.deepEqual(resident.approach(new Set([0, a, c]), 3400, 1000), []);
  assert.deepEqual(resident.approach(new Set([0, c]), 3600, 1000), []);
  assert.deepEqual(resident.makeRoom(50, new Set([0, c])), [
    { kind: "close", group: a },
    { kind: "free", group: a },
  ]);
  resident.makeRoom(resident.bytes, new Set());
  assert.deepEqual([resident.bytes, resident.open.size, resident.has(0)], [0, 0, false]);
});

test("requests follow the target's order, with parents before children and no more than allowed", () => {
  const { levels } = randomMesh(9, 800, 10);
  const index = indexOf(levels);
  const resident = new ResidentGroups(index);
  resident.add(0, 1);
  const children = [...index.children(0)];
  const [child = 0, ...rest] = children;
  const target = new Set([0, ...children, ...index.children(child)]);
  const pending = new Set([child, 9999]);
  assert.deepEqual(requestChanges(index, target, resident, pending, 3), {
    request: rest.slice(0, 2),
    withdraw: [9999],
  });
  assert.deepEqual(requestChanges(index, target, resident, new Set(), 0).request, []);
  const all = requestChanges(index, target, resident, new Set(), 1000).request;
  assert.deepEqual(all, [...target].slice(1));
});
