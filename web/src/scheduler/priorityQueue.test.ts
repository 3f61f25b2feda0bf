import assert from "node:assert/strict";
import { describe, test } from "node:test";
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
