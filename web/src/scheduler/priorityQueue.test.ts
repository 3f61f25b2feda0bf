import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { ByteSemaphore } from "./byteSemaphore.ts";
import type { QueueEntry } from "./priorityQueue.ts";
import { PriorityQueue } from "./priorityQueue.ts";

interface Numbered {
  priority: number;
  readonly turn: number;
}

/** Numbers that look random and are the same in every run. */
function* numbers(seed: number): Generator<number, never> {
  for (let state = seed; ;) yield (state = (state * 48271) % 2147483647);
}

/** What a queue of these must give: the plainest way to say it. */
function sorted(items: readonly Numbered[]): Numbered[] {
  return items.toSorted((a, b) => b.priority - a.priority || a.turn - b.turn);
}

function drained<Item extends Numbered>(queue: PriorityQueue<Item>): Item[] {
  const items: Item[] = [];
  for (let item = queue.pop(); item !== undefined; item = queue.pop()) items.push(item);
  return items;
}

describe("a queue", () => {
  test("gives what a sorted list gives, whatever is pushed, removed, changed and popped in between", () => {
    for (let seed = 1; seed <= 50; ++seed) {
      const random = numbers(seed);
      const below = (limit: number) => random.next().value % limit;
      const queue = new PriorityQueue<Numbered>();
      let entries: QueueEntry<Numbered>[] = [];
      for (let turn = 0; turn < 300; ++turn) {
        const chosen = entries[below(Math.max(entries.length, 1))];
        switch (below(5)) {
          case 0:
          case 1:
            entries.push(queue.push({ priority: below(20), turn }));
            break;
          case 2:
            if (chosen !== undefined) queue.remove(chosen);
            entries = entries.filter((entry) => entry !== chosen);
            break;
          case 3:
            for (const { item } of entries) item.priority = below(20);
            queue.reorder();
            break;
          default: {
            const [first] = sorted(entries.map(({ item }) => item));
            assert.equal(queue.first, first);
            assert.equal(queue.pop(), first);
            entries = entries.filter(({ item }) => item !== first);
          }
        }
        assert.equal(queue.size, entries.length);
      }
      assert.deepEqual(drained(queue), sorted(entries.map(({ item }) => item)));
    }
  });

  test("is left once: a second leave does nothing", () => {
    const queue = new PriorityQueue<Numbered>();
    const entries = [1, 2, 3].map((priority, turn) => queue.push({ priority, turn }));
    for (const entry of entries.slice(1).flatMap((each) => [each, each])) queue.remove(entry);
    assert.deepEqual(
      drained(queue).map(({ priority }) => priority),
      [1],
    );
    for (const entry of entries) queue.remove(entry);
    assert.equal(queue.size, 0);
  });
});

describe("a backlog", () => {
  const { signal } = new AbortController();
  const soon = () => new Promise((resolve) => setTimeout(resolve, 0));

  test("lets in what fits, in order, and the next when something leaves", async () => {
    const backlog = new ByteSemaphore(10);
    const inside: number[] = [];
    const entered = [6, 4, 5, 1].map(async (bytes) => {
      const leave = await backlog.acquire(bytes, signal);
      inside.push(bytes);
      return leave;
    });
    await soon();
    assert.deepEqual(inside, [6, 4]); // 1 waits behind 5
    (await entered[0])?.();
    await soon();
    assert.deepEqual(inside, [6, 4, 5, 1]);
    assert.equal(backlog.bytes, 10);
  });

  test("gets its room back once for each entry", async () => {
    const backlog = new ByteSemaphore(10);
    const leave = await backlog.acquire(10, signal);
    const second = await backlog.acquire(0, signal);
    leave();
    leave();
    assert.equal(backlog.bytes, 0);
    second();
    assert.equal(backlog.bytes, 0);
  });

  test("lets in alone what is larger than all of it", async () => {
    const backlog = new ByteSemaphore(10);
    const small = await backlog.acquire(1, signal);
    let isInside = false;
    const large = backlog.acquire(100, signal).then((leave) => {
      isInside = true;
      return leave;
    });
    await soon();
    assert.equal(isInside, false);
    small();
    (await large)();
    assert.equal(backlog.bytes, 0);
  });

  test("is left by what is aborted while it waits, to the good of what is behind", async () => {
    const backlog = new ByteSemaphore(10);
    const leave = await backlog.acquire(8, signal);
    const aborter = new AbortController();
    const gone = backlog.acquire(9, aborter.signal);
    const behind = backlog.acquire(2, signal);
    aborter.abort(new Error("removed"));
    await assert.rejects(gone, { message: "removed" });
    (await behind)();
    leave();
    assert.equal(backlog.bytes, 0);
    await assert.rejects(backlog.acquire(1, aborter.signal), { message: "removed" });
  });
});
