// What a batch knows of the stored coordinates of its members, by the index of their records: in one array, because a
// scene may move a thousand members in every frame, and memory that lies apart would take most of that time.

import type { BatchedDraw } from "./batch.ts";

/** The point of stored coordinates 0, the lattice step, and centre and radius of the bounds in stored coordinates. */
export const numbersPerFrame = 10;

export class StoredFrames {
  #numbers = new Float64Array(64 * numbersPerFrame);

  /** Valid until the next `set`. */
  get numbers(): Float64Array {
    return this.#numbers;
  }

  set(instanceIndex: number, { origin, step, bounds: { center, radius } }: BatchedDraw): void {
    const at = instanceIndex * numbersPerFrame;
    if (at >= this.#numbers.length) {
      const numbers = new Float64Array(2 * Math.max(this.#numbers.length, at));
      numbers.set(this.#numbers);
      this.#numbers = numbers;
    }
    this.#numbers.set([...origin, ...step, center.x, center.y, center.z, radius], at);
  }
}
