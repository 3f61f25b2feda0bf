import assert from "node:assert/strict";
import { test } from "node:test";
import { TestRandom } from "../decode/compact/rangeEncoder.testing.ts";
import type { CutMesh } from "./cut.ts";
import { chooseCut, closingRatio, groupMemory } from "./cut.ts";
import { LevelIndex } from "./levelIndex.ts";
import { illegalityOf, indexOf, pagePayload, randomMesh } from "./levels.testing.ts";
import { perspectiveView, randomView } from "./levelViews.testing.ts";
import type { LevelView } from "./projectedError.ts";
import { errorInPixels } from "./projectedError.ts";

const none: ReadonlySet<number> = new Set();
const { levels } = randomMesh(2, 3000, 10);
const index = indexOf(levels);
const all = levels.groups.map((_, group) => group);

function meshOf(view: LevelView, rest: Partial<CutMesh> = {}): CutMesh {
  const of = rest.index ?? index;
  const measure = errorInPixels(of, [view]);
  return { index: of, errorInPixels: measure, open: none, absent: none, bytesPerVertex: 12, ...rest };
}

const memoryOf = (groups: Iterable<number>) =>
  [...groups].reduce((sum, group) => sum + groupMemory({ index, bytesPerVertex: 12 }, group), 0);

test("without a limit of memory the cut has exactly the groups above the tolerance", () => {
  const random = new TestRandom(1);
  for (let n = 0; n < 100; ++n) {
    const mesh = meshOf(randomView(random));
    const cut = chooseCut([mesh], { tolerance: 1, budget: Infinity });
    const expected = all.filter((group) => mesh.errorInPixels(group) > 1);
    assert.deepEqual(
      [...cut.meshes[0]!.target].sort((a, b) => a - b),
      expected,
    );
    assert.equal(cut.bytes, memoryOf(expected));
  }
});

test("every prefix of every cut is legal, and none exceeds the budget", () => {
  const random = new TestRandom(2);
  for (let n = 0; n < 60; ++n) {
    const budget = memoryOf([0]) + random.below(2e6);
    const cut = chooseCut([meshOf(randomView(random))], { tolerance: 0.2, budget });
    const prefix = new Set<number>();
    for (const group of cut.meshes[0]!.target) {
      prefix.add(group);
      assert.equal(illegalityOf(levels, prefix), undefined);
    }
    assert.ok(cut.bytes <= budget && cut.bytes === memoryOf(prefix));
  }
});

test("groups enter by their error: what a budget leaves out has no larger error than what is in", () => {
  const random = new TestRandom(3);
  for (let n = 0; n < 60; ++n) {
    const mesh = meshOf(randomView(random));
    const cut = chooseCut([mesh], { tolerance: 0.01, budget: memoryOf([0]) + random.below(1e6) });
    const { target } = cut.meshes[0]!;
    const inside = [...target].map((group) => mesh.errorInPixels(group));
    assert.deepEqual(
      inside,
      inside.toSorted((a, b) => b - a),
    );
    for (const group of all) if (!target.has(group)) assert.ok(mesh.errorInPixels(group) <= inside.at(-1)!);
  }
});

test("the roots are in the cut whatever the budget", () => {
  const cut = chooseCut([meshOf(randomView(new TestRandom(4)))], { tolerance: 1, budget: 0 });
  assert.deepEqual([...cut.meshes[0]!.target], [0]);
});

test("an open group stays open down to 0.7 of the tolerance, and is closed below", () => {
  const random = new TestRandom(5);
  for (let n = 0; n < 50; ++n) {
    const view = randomView(random);
    const measure = errorInPixels(index, [view]);
    const before = chooseCut([meshOf(view)], { tolerance: 0.5, budget: Infinity }).meshes[0]!.target;
    const after = chooseCut([meshOf(view, { open: before })], { tolerance: 1, budget: Infinity }).meshes[0]!.target;
    for (const group of before) assert.equal(after.has(group), measure(group) > closingRatio, `${measure(group)}`);
    assert.equal(illegalityOf(levels, after), undefined);
  }
});

test("absent groups, and those below them, are not in the cut", () => {
  const view = perspectiveView([32768, 32768, 40000], {});
  const options = { tolerance: 0.01, budget: Infinity };
  const whole = chooseCut([meshOf(view)], options).meshes[0]!.target;
  const absent = new Set([...whole].slice(3, 6));
  const { target } = chooseCut([meshOf(view, { absent })], options).meshes[0]!;
  for (const group of absent) assert.equal(target.has(group), false);
  assert.equal(illegalityOf(levels, target), undefined);
  assert.ok(target.size > 3 && target.size < whole.size);
});

test("groups on pages that are not here wait, and their pages are asked for", () => {
  const partial = new LevelIndex(pagePayload(levels, 0));
  const view = perspectiveView([32768, 32768, 40000], {});
  const options = { tolerance: 0.05, budget: Infinity };
  const whole = chooseCut([meshOf(view)], options).meshes[0]!.target;
  let rounds = 0;
  for (;;) {
    const { target, missingPages } = chooseCut([meshOf(view, { index: partial })], options).meshes[0]!;
    assert.equal(illegalityOf(levels, target), undefined);
    const [page] = missingPages;
    if (page === undefined) {
      assert.deepEqual(new Set(target), new Set(whole));
      break;
    }
    assert.equal(partial.hasPage(page), false);
    partial.addPage(page, pagePayload(levels, page));
    ++rounds;
  }
  assert.ok(rounds > 2);
});

test("several meshes share a budget by their errors", () => {
  const other = randomMesh(11, 2000, 10).levels;
  const near = meshOf(perspectiveView([32768, 32768, 50000], {}));
  const far = meshOf(perspectiveView([32768, 32768, 900000], {}), { index: indexOf(other) });
  const budget = 400_000;
  const [a, b] = chooseCut([near, far], { tolerance: 0.001, budget }).meshes;
  assert.ok(a!.target.size > 1 && a!.target.size > 2 * b!.target.size);
  const errors = [...a!.target].map((group) => near.errorInPixels(group));
  const farErrors = [...b!.target].map((group) => far.errorInPixels(group));
  const reversed = chooseCut([far, near], { tolerance: 0.001, budget });
  assert.deepEqual([reversed.meshes[1]!.target, reversed.meshes[0]!.target], [a!.target, b!.target]);
  assert.ok(Math.min(...errors, ...farErrors) > 0);
});

test("a cut through 41,000 groups takes little time (printed)", (context) => {
  const large = indexOf(randomMesh(7, 41_000 * 6, 8, 1024).levels);
  const mesh = meshOf(perspectiveView([32768, 32768, 60000], {}), { index: large });
  for (const [tolerance, budget] of [
    [1, Infinity],
    [0.3, Infinity],
    [0.01, 1e6],
    [0.01, 4e6],
  ] as const) {
    let open: ReadonlySet<number> = none;
    const times: number[] = [];
    for (let n = 0; n < 60; ++n) {
      const start = performance.now();
      open = chooseCut([{ ...mesh, open }], { tolerance, budget }).meshes[0]!.target;
      times.push(performance.now() - start);
    }
    const median = times.sort((a, b) => a - b)[30]!;
    context.diagnostic(
      `${large.groupCount} groups, ${open.size} open, tolerance ${tolerance}: ${median.toFixed(2)} ms`,
    );
    assert.ok(open.size > 10);
  }
});
