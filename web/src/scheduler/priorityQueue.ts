// What waits, most important first: a binary heap. Priorities belong to the
// things themselves and may change at any time; the heap orders by what they
// were when it last looked, so that it is a heap at every moment, and looks
// again when it is told to.

/** Something with a priority that its owner may change while it waits. */
export interface Prioritised {
  /** Larger goes first. */
  readonly priority: number;
}

/** A place in a queue, to leave it by. */
export interface QueueEntry<Item extends Prioritised> {
  readonly item: Item;
  /** Of the item, when the queue last looked. */
  key: number;
  /** Equal keys leave in the order in which they came. */
  readonly turn: number;
  /** Index in the heap; -1 after leaving. */
  place: number;
}

export class PriorityQueue<Item extends Prioritised> {
  readonly #heap: QueueEntry<Item>[] = [];
  #turns = 0;

  get size(): number {
    return this.#heap.length;
  }

  /** What `pop` would take. */
  get first(): Item | undefined {
    return this.#heap[0]?.item;
  }

  /** O(log n). */
  push(item: Item): QueueEntry<Item> {
    const entry = { item, key: item.priority, turn: this.#turns++, place: this.#heap.length };
    this.#heap.push(entry);
    this.#rise(entry);
    return entry;
  }

  /** Takes the first out; O(log n). */
  pop(): Item | undefined {
    const first = this.#heap[0];
    if (first === undefined) return undefined;
    this.remove(first);
    return first.item;
  }

  /** O(log n); what has left already is left alone. */
  remove(entry: QueueEntry<Item>): void {
    const { place } = entry;
    const last = this.#heap.at(-1);
    if (place < 0 || last === undefined) return;
    this.#heap.pop();
    entry.place = -1;
    if (last === entry) return;
    this.#put(last, place);
    this.#rise(last);
    this.#sink(last);
  }

  /** Looks at all priorities again; O(n). */
  reorder(): void {
    for (const entry of this.#heap) entry.key = entry.item.priority;
    for (let place = (this.#heap.length >> 1) - 1; place >= 0; --place) {
      const entry = this.#heap[place];
      if (entry !== undefined) this.#sink(entry);
    }
  }

  #rise(entry: QueueEntry<Item>): void {
    while (entry.place > 0) {
      const parent = this.#heap[(entry.place - 1) >> 1];
      if (parent === undefined || !goesBefore(entry, parent)) return;
      this.#exchange(entry, parent);
    }
  }

  #sink(entry: QueueEntry<Item>): void {
    for (;;) {
      const left = this.#heap[2 * entry.place + 1];
      const right = this.#heap[2 * entry.place + 2];
      const child = left !== undefined && right !== undefined && goesBefore(right, left) ? right : left;
      if (child === undefined || !goesBefore(child, entry)) return;
      this.#exchange(child, entry);
    }
  }

  #exchange(a: QueueEntry<Item>, b: QueueEntry<Item>): void {
    const { place } = a;
    this.#put(a, b.place);
    this.#put(b, place);
  }

  #put(entry: QueueEntry<Item>, place: number): void {
    this.#heap[place] = entry;
    entry.place = place;
  }
}

function goesBefore(a: { key: number; turn: number }, b: { key: number; turn: number }): boolean {
  return a.key > b.key || (a.key === b.key && a.turn < b.turn);
}
