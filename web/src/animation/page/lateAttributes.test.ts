import assert from "node:assert/strict";
import type { TestContext } from "node:test";
import { test } from "node:test";
import type { FieldChange } from "../documentGraph.ts";
import { LateAttributes } from "./lateAttributes.ts";

interface Watched {
  readonly attributes: LateAttributes;
  readonly changes: readonly FieldChange[];
  /** How many changes were written at a time, since the last call. */
  readonly takeCounts: () => readonly number[];
  readonly written: readonly FieldChange[];
  readonly passTime: (milliseconds: number) => void;
}

/** LateAttributes under a clock that the test sets, and `count` changes. */
function watch({ mock }: TestContext, count: number, isForLists = false): Watched {
  mock.timers.enable({ apis: ["setTimeout"] });
  let now = 1000;
  mock.method(performance, "now", () => now);
  const [counts, written] = [[] as number[], [] as FieldChange[]];
  const write = (changes: Iterable<FieldChange>): void => {
    const before = written.length;
    counts.push(written.push(...changes) - before);
  };
  return {
    attributes: new LateAttributes(write, isForLists),
    changes: Array.from({ length: count }, () => ({ isLate: false }) as FieldChange),
    takeCounts: () => counts.splice(0),
    written,
    passTime: (milliseconds) => {
      now += milliseconds;
      mock.timers.tick(milliseconds);
    },
  };
}

/** All values change. */
function change({ attributes, changes }: Watched): void {
  for (const each of changes) attributes.add(each);
  attributes.schedule();
}

test("values after a rest are written at once, and those that follow a tenth of a second later", (context) => {
  const watched = watch(context, 3);
  change(watched);
  assert.deepEqual(watched.takeCounts(), [3]);
  watched.passTime(20);
  change(watched);
  watched.passTime(20);
  change(watched); // is written with what is late already
  watched.passTime(79);
  assert.deepEqual(watched.takeCounts(), []);
  watched.passTime(1);
  assert.deepEqual(watched.takeCounts(), [3]);
  watched.passTime(1000);
  assert.deepEqual(watched.takeCounts(), []);
  change(watched);
  assert.deepEqual(watched.takeCounts(), [3]);
});

test("of many attributes that follow, 16 are written at a time, in turns, and all soon after the last", (context) => {
  const watched = watch(context, 200);
  change(watched);
  assert.deepEqual(watched.takeCounts(), [200]);
  for (let frame = 0; frame < 60; ++frame) {
    watched.passTime(16);
    change(watched);
  }
  const counts = watched.takeCounts();
  assert.ok(counts.length > 40, `${counts.length} times`);
  assert.ok(counts.every((count) => count <= 16));
  const timesOf = watched.changes.map((each) => watched.written.filter((one) => one === each).length);
  assert.ok(Math.min(...timesOf) >= Math.floor(counts.length / 13), "none waits for more than 13 slices");
  for (let frame = 0; frame < 8; ++frame) watched.passTime(16);
  assert.ok(
    watched.changes.every((each) => !each.isLate),
    "all have been written when nothing moves any more",
  );
});

test("a reading of the document has all that is late", (context) => {
  const watched = watch(context, 200);
  change(watched);
  watched.passTime(20);
  change(watched);
  watched.passTime(90);
  change(watched);
  watched.passTime(20);
  watched.takeCounts();
  watched.attributes.writeNow();
  assert.deepEqual(watched.takeCounts(), [184]);
  watched.passTime(1000);
  assert.deepEqual(watched.takeCounts(), []);
});

test("lists are written when they have come to rest", (context) => {
  const watched = watch(context, 1, true);
  for (let frame = 0; frame < 60; ++frame) {
    change(watched);
    watched.passTime(16);
  }
  assert.deepEqual(watched.takeCounts(), []);
  watched.passTime(100);
  assert.deepEqual(watched.takeCounts(), [1]);
});
