import type { ElementArray } from "../../stage/vertexArray.ts";

/** A typed array that is longer than what of it is used, so that it grows by and by. */
export class GrowingArray<Elements extends ElementArray> {
  readonly #type: new (length: number) => Elements;
  #array: Elements;
  #length = 0;

  constructor(type: new (length: number) => Elements, capacity = 1024) {
    this.#type = type;
    this.#array = new type(capacity);
  }

  get length(): number {
    return this.#length;
  }

  /** Valid until it grows, as all that shares its memory. */
  get used(): Elements {
    return this.#array.subarray(0, this.#length) as Elements;
  }

  /** So many elements more, which are returned. Those that were used before are as they were left. */
  extend(count: number): Elements {
    const first = this.#length;
    this.#length += count;
    if (this.#length > this.#array.length) {
      const grown = new this.#type(Math.max(this.#length, 2 * this.#array.length));
      grown.set(this.#array.subarray(0, first));
      this.#array = grown;
    }
    return this.#array.subarray(first, this.#length) as Elements;
  }

  clear(): void {
    this.#length = 0;
  }
}
