// A priority queue as a binary heap. Priorities belong to the items and may change at any time: the heap is ordered by
// the keys that it read last, and reads all priorities again when `reorder` is called.

/** An object whose priority may change while it is in a queue. */
export interface Prioritized {
  /** Objects of larger priority leave the queue first. */
  readonly priority: number;
}

/** An item in a queue; `remove` takes it out. */
export interface QueueEntry<Item extends Prioritized> {
  readonly item: Item;
  /** The item's priority when the queue last read it. */
  key: number;
  /** Items of equal keys leave in the order in which they were pushed. */
  readonly sequence: number;
  /** Index in the heap; -1 once removed. */
  heapIndex: number;
}

export class PriorityQueue<Item extends Prioritized> {
  readonly #heap: QueueEntry<Item>[] = [];
  #nextSequence = 0;

  get size(): number {
    return this.#heap.length;
  }

  /** The item that `pop` would return. */
  get first(): Item | undefined {
    return this.#heap[0]?.item;
  }

  /** O(log n). */
  push(item: Item): QueueEntry<Item> {
    const entry = { item, key: item.priority, sequence: this.#nextSequence++, heapIndex: this.#heap.length };
    this.#heap.push(entry);
    this.#rise(entry);
    return entry;
  }

  /** Removes and returns the first item; O(log n). */
  pop(): Item | undefined {
    const first = this.#heap[0];
    if (first === undefined) return undefined;
    this.remove(first);
    return first.item;
  }

  /** O(log n); does nothing for an entry that is removed already. */
  remove(entry: QueueEntry<Item>): void {
    const { heapIndex } = entry;
    const last = this.#heap.at(-1);
    if (heapIndex < 0 || last === undefined) return;
    this.#heap.pop();
    entry.heapIndex = -1;
    if (last === entry) return;
    this.#put(last, heapIndex);
    this.#rise(last);
    this.#sink(last);
  }

  /** Reads all priorities again; O(n). */
  reorder(): void {
    for (const entry of this.#heap) entry.key = entry.item.priority;
    for (let index = (this.#heap.length >> 1) - 1; index >= 0; --index) {
      const entry = this.#heap[index];
      if (entry !== undefined) this.#sink(entry);
    }
  }

  #rise(entry: QueueEntry<Item>): void {
    while (entry.heapIndex > 0) {
      const parent = this.#heap[(entry.heapIndex - 1) >> 1];
      if (parent === undefined || !goesBefore(entry, parent)) return;
      this.#exchange(entry, parent);
    }
  }

  #sink(entry: QueueEntry<Item>): void {
    for (;;) {
      const left = this.#heap[2 * entry.heapIndex + 1];
      const right = this.#heap[2 * entry.heapIndex + 2];
      const child = left !== undefined && right !== undefined && goesBefore(right, left) ? right : left;
      if (child === undefined || !goesBefore(child, entry)) return;
      this.#exchange(child, entry);
    }
  }

  #exchange(a: QueueEntry<Item>, b: QueueEntry<Item>): void {
    const { heapIndex } = a;
    this.#put(a, b.heapIndex);
    this.#put(b, heapIndex);
  }

  #put(entry: QueueEntry<Item>, heapIndex: number): void {
    this.#heap[heapIndex] = entry;
    entry.heapIndex = heapIndex;
  }
}

function goesBefore(a: { key: number; sequence: number }, b: { key: number; sequence: number }): boolean {
  return a.key > b.key || (a.key === b.key && a.sequence < b.sequence);
}
