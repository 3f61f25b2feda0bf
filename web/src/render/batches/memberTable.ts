// Where the members of batches are, by the index of their records: in one array, because a scene may move a thousand
// members in every frame, and memory that lies apart would take most of that time.

import type { Sphere } from "three";

/** What of a BatchedDraw says where its vertices are. */
interface StoredDraw {
  readonly origin: readonly number[];
  readonly step: readonly number[];
  readonly bounds: Sphere;
}

/** Offset of each field in the row of a member. */
export const memberFields = {
  /** The point of stored coordinates 0, in the shape's coordinates. */
  origin: 0,
  /** The lattice step. */
  step: 3,
  /** Centre and radius of the bounds, in stored coordinates. */
  storedBounds: 6,
  /** Centre and radius of the bounds, in the coordinates of the batches' root. */
  sphere: 10,
} as const;
export const numbersPerMember = 14;

export class MemberTable {
  #numbers = new Float64Array(64 * numbersPerMember);

  /** All rows. Valid until the next `add`. */
  get numbers(): Float64Array {
    return this.#numbers;
  }

  /** Begins the row of a member: everything but its sphere. */
  add(instanceIndex: number, { origin, step, bounds: { center, radius } }: StoredDraw): void {
    const at = instanceIndex * numbersPerMember;
    if (at >= this.#numbers.length) {
      const numbers = new Float64Array(2 * Math.max(this.#numbers.length, at));
      numbers.set(this.#numbers);
      this.#numbers = numbers;
    }
    this.#numbers.set([...origin, ...step, center.x, center.y, center.z, radius], at);
  }

  /** Copies a member's bounds to `target`, which it returns. */
  sphereOf(instanceIndex: number, target: Sphere): Sphere {
    const at = instanceIndex * numbersPerMember + memberFields.sphere;
    target.center.fromArray(this.#numbers, at);
    target.radius = this.#numbers[at + 3] ?? 0;
    return target;
  }
}
