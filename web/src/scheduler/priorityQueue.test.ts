import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { ByteSemaphore } from "./byteSemaphore.ts";
import type { QueueEntry } from "./priorityQueue.ts";
import { PriorityQueue } from "./priorityQueue.ts";

interface Numbered {
  priority: number;
  readonly turn: number;
}

/** Pseudorandom numbers, the same in every run. */
function* numbers(seed: number): Generator<number, never> {
  for (let state = seed; ;) yield (state = (state * 48271) % 2147483647);
}

/** The order in which a queue of these items must return them. */
function sorted(items: readonly Numbered[]): Numbered[] {
  return items.toSorted((a, b) => b.priority - a.priority || a.turn - b.turn);
}

function popAll<Item extends Numbered>(queue: PriorityQueue<Item>): Item[] {
  const items: Item[] = [];
  for (let item = queue.pop(); item !== undefined; item = queue.pop()) items.push(item);
  return items;
}

describe("a queue", () => {
  test("behaves as a sorted list does, whatever is pushed, removed, changed and popped", () => {
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
      assert.deepEqual(popAll(queue), sorted(entries.map(({ item }) => item)));
    }
  });

  test("ignores a second removal of an entry", () => {
    const queue = new PriorityQueue<Numbered>();
    const entries = [1, 2, 3].map((priority, turn) => queue.push({ priority, turn }));
    for (const entry of entries.slice(1).flatMap((each) => [each, each])) queue.remove(entry);
    assert.deepEqual(
      popAll(queue).map(({ priority }) => priority),
      [1],
    );
    for (const entry of entries) queue.remove(entry);
    assert.equal(queue.size, 0);
  });
});

describe("a byte semaphore", () => {
  const { signal } = new AbortController();
  const soon = () => new Promise((resolve) => setTimeout(resolve, 0));

  test("admits entries in order while they fit, and the next when one is released", async () => {
    const semaphore = new ByteSemaphore(10);
    const inside: number[] = [];
    const entered = [6, 4, 5, 1].map(async (bytes) => {
      const release = await semaphore.acquire(bytes, signal);
      inside.push(bytes);
      return release;
    });
    await soon();
    assert.deepEqual(inside, [6, 4]); // 1 waits behind 5
    (await entered[0])?.();
    await soon();
    assert.deepEqual(inside, [6, 4, 5, 1]);
    assert.equal(semaphore.bytes, 10);
  });

  test("gets the bytes of an entry back once", async () => {
    const semaphore = new ByteSemaphore(10);
    const release = await semaphore.acquire(10, signal);
    const second = await semaphore.acquire(0, signal);
    release();
    release();
    assert.equal(semaphore.bytes, 0);
    second();
    assert.equal(semaphore.bytes, 0);
  });

  test("admits an entry that is larger than the limit alone", async () => {
    const semaphore = new ByteSemaphore(10);
    const small = await semaphore.acquire(1, signal);
    let isInside = false;
    const large = semaphore.acquire(100, signal).then((release) => {
      isInside = true;
      return release;
    });
    await soon();
    assert.equal(isInside, false);
    small();
    (await large)();
    assert.equal(semaphore.bytes, 0);
  });

  test("drops an entry that is aborted while it waits, and admits those after it", async () => {
    const semaphore = new ByteSemaphore(10);
    const release = await semaphore.acquire(8, signal);
    const aborter = new AbortController();
    const aborted = semaphore.acquire(9, aborter.signal);
    const behind = semaphore.acquire(2, signal);
    aborter.abort(new Error("removed"));
    await assert.rejects(aborted, { message: "removed" });
    (await behind)();
    release();
    assert.equal(semaphore.bytes, 0);
    await assert.rejects(semaphore.acquire(1, aborter.signal), { message: "removed" });
  });
});
