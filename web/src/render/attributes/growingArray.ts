import type { ElementArray } from "../../stage/vertexArray.ts";

/** A typed array with spare capacity, which doubles when it is full. */
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

  /** The elements that are in use. Valid until the next `extend`, which may replace the memory. */
  get used(): Elements {
    return this.#array.subarray(0, this.#length) as Elements;
  }

  /** Appends `count` elements and returns them. Their content is undefined: it may be left over from before `clear`. */
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
