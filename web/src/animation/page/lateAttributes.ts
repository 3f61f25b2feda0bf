// Writes the values of fields that move into attributes, so that scripts and style sheets see them. Text for a thousand
// attributes takes longer than moving what they describe: so it is written at once after a rest, and otherwise ten times
// a second, between frames; of many attributes some at a time, in turns, and faster when nothing moves any more. Lists
// are long: they are written when they have come to rest.

import type { FieldChange } from "../documentGraph.ts";

/** Milliseconds from a value to its text; of a list, from its last value. */
const delay = 100;
/** Attributes that are written at a time, between two frames: a thousand take a second. */
const sliceLength = 16;
/** The same when no value has come for `delay`. */
const restingSliceLength = 256;
/** Milliseconds between the slices of many attributes: about a frame. */
const sliceDelay = 16;
/** Milliseconds without values after which the next one is written at once. */
const rest = 500;

export class LateAttributes {
  readonly #write: (changes: Iterable<FieldChange>) => void;
  readonly #isForLists: boolean;
  readonly #late: FieldChange[] = [];
  /** When the last value has come. */
  #changedAt = -Infinity;
  #timer: ReturnType<typeof setTimeout> | undefined;

  /** `write` writes the present values of changes. */
  constructor(write: (changes: Iterable<FieldChange>) => void, isForLists: boolean) {
    this.#write = write;
    this.#isForLists = isForLists;
  }

  /** A field has got a value: see `schedule`. */
  add(change: FieldChange): void {
    if (change.isLate) return;
    change.isLate = true;
    this.#late.push(change);
  }

  /** Writes the attributes of fields that have been added, now or later. */
  schedule(): void {
    if (this.#late.length === 0) return;
    const now = performance.now();
    const hasRested = now - this.#changedAt > rest;
    this.#changedAt = now;
    if (hasRested && !this.#isForLists) {
      this.writeNow();
      return;
    }
    if (this.#isForLists) clearTimeout(this.#timer);
    if (this.#isForLists || this.#timer === undefined) this.#writeSoon(delay);
  }

  #writeSoon(milliseconds: number): void {
    this.#timer = setTimeout(() => {
      this.#timer = undefined;
      const isResting = performance.now() - this.#changedAt >= delay;
      this.#writeFirst(isResting ? restingSliceLength : sliceLength);
      if (this.#late.length > 0) this.#writeSoon(sliceDelay);
    }, milliseconds);
  }

  /** Writes all that are late. */
  writeNow(): void {
    clearTimeout(this.#timer);
    this.#timer = undefined;
    this.#writeFirst(this.#late.length);
  }

  #writeFirst(count: number): void {
    if (this.#late.length === 0) return;
    const first = this.#late.splice(0, count);
    for (const change of first) change.isLate = false;
    this.#write(first);
  }

  dispose(): void {
    clearTimeout(this.#timer);
    this.#late.length = 0;
  }
}
