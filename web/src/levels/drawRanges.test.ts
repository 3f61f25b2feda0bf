import assert from "node:assert/strict";
import { test } from "node:test";
import { TestRandom } from "../decode/compact/rangeEncoder.testing.ts";
import { drawRanges } from "./drawRanges.ts";
import type { TestMesh } from "./levels.testing.ts";
import { randomMesh } from "./levels.testing.ts";

test("adjacent segments of closed children are one range", () => {
  const draw = (...open: number[]) =>
    drawRanges([11, 12, 15, 19], [0, 4, 6, 7, 10], new Set(open)).map(({ first, count }) => [first, count]);
  assert.deepEqual(draw(), [[0, 10]]);
  assert.deepEqual(draw(11), [[4, 6]]);
  assert.deepEqual(draw(12, 13), [
    [0, 4],
    [6, 4],
  ]);
  assert.deepEqual(draw(15, 19), [[0, 6]]);
  assert.deepEqual(draw(11, 12, 15, 19), []);
});

test("all of a group on level 0 is drawn", () => {
  assert.deepEqual(drawRanges([], [0, 77], new Set([1])), [{ first: 0, count: 77 }]);
});

test("a wrong number of segments is a mistake of the caller", () => {
  assert.throws(() => drawRanges([3, 4], [0, 7], new Set()), /2 starts of the segments of 2 children/);
});

/** How often each item is drawn. */
function drawnCounts({ levels, segments, itemCount }: TestMesh, open: ReadonlySet<number>): Uint8Array {
  const counts = new Uint8Array(itemCount);
  for (const group of open) {
    const { items, segmentStarts } = segments[group]!;
    for (const { first, count } of drawRanges(levels.groups[group]!.children, segmentStarts, open))
      for (const item of items.slice(first, first + count)) ++counts[item]!;
  }
  return counts;
}

test("every legal cut draws each item of a fake mesh once, and an illegal one does not", () => {
  const random = new TestRandom(1);
  for (let seed = 0; seed < 20; ++seed) {
    const mesh = randomMesh(seed, 300 + random.below(900), 5 + random.below(20));
    const { groups, rootCount } = mesh.levels;
    const parents = groups.map((_, child) =>
      groups.flatMap(({ children }, p) => (children.includes(child) ? [p] : [])),
    );
    assert.ok(
      parents.some(({ length }) => length > 1),
      "groups have several parents",
    );
    const openedWith = (chance: number) => {
      const open = new Set<number>();
      for (const group of groups.keys())
        if (group < rootCount || (random.below(100) < chance && parents[group]!.every((parent) => open.has(parent))))
          open.add(group);
      return open;
    };
    for (const chance of [0, 20, 50, 70, 90, 97, 100]) {
      const open = openedWith(chance);
      assert.ok(
        drawnCounts(mesh, open).every((count) => count === 1),
        `seed ${seed}, ${open.size} groups open`,
      );
    }
    const child = groups.findIndex((_, group) => parents[group]!.length > 1);
    const illegal = new Set([0, parents[child]![0]!, child]);
    assert.ok(
      drawnCounts(mesh, illegal).some((count) => count !== 1),
      "the test notices open groups without parents",
    );
  }
});
