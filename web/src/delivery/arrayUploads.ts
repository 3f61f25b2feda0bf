// The arrays of one patch on their way out of JavaScript: each is stored once,
// whichever attributes read it, and given back when the last of them is gone.

import type { ElementArray, IndexArray, VertexArray } from "../stage/vertexArray.ts";
import { elementTypeOf } from "../stage/elementType.ts";
import type { ArrayUse, StoredBytes, StoredIndex, StoredVertices } from "../stage/stage.ts";

/** Brings an array to where draws read it. Rejects with the signal's reason; nothing is then left behind. */
export type StoreBytes = (array: ElementArray, use: ArrayUse, signal: AbortSignal) => Promise<StoredBytes>;

export class ArrayUploads {
  readonly #store: StoreBytes;
  /** By the memory that the bytes come from, and their place in it: records of a file hold several attributes. */
  readonly #stored = new WeakMap<ArrayBuffer, Map<string, Promise<StoredBytes>>>();
  readonly #uses = new Map<StoredBytes, number>();
  #retired: StoredBytes[] = [];

  constructor(store: StoreBytes) {
    this.#store = store;
  }

  /** Of all that is stored and not given back. */
  get byteLength(): number {
    let sum = 0;
    for (const { byteLength } of this.#uses.keys()) sum += byteLength;
    return sum;
  }

  async storeVertices(
    { array, components, stride, offset }: VertexArray,
    signal: AbortSignal,
  ): Promise<StoredVertices> {
    return {
      bytes: await this.#bytesOf(array, "vertices", signal),
      type: elementTypeOf(array),
      components,
      stride,
      offset,
    };
  }

  async storeIndex(array: IndexArray, signal: AbortSignal): Promise<StoredIndex> {
    return { bytes: await this.#bytesOf(array, "index", signal), type: elementTypeOf(array) };
  }

  /** These are used no more after the next stage; once each. */
  retire(...arrays: readonly ({ readonly bytes: StoredBytes } | undefined)[]): void {
    for (const array of arrays) if (array !== undefined) this.#retired.push(array.bytes);
  }

  /** Gives back what has been retired; no stage that used it may be drawn any more. */
  sweep(): void {
    for (const bytes of this.#retired.splice(0)) {
      const uses = (this.#uses.get(bytes) ?? 0) - 1;
      if (uses > 0) {
        this.#uses.set(bytes, uses);
      } else {
        this.#uses.delete(bytes);
        bytes.close();
      }
    }
  }

  async #bytesOf(array: ElementArray, use: ArrayUse, signal: AbortSignal): Promise<StoredBytes> {
    const places = this.#stored.get(array.buffer) ?? new Map<string, Promise<StoredBytes>>();
    this.#stored.set(array.buffer, places);
    const place = `${use} ${array.byteOffset}+${array.byteLength}`;
    const begun = places.get(place);
    if (begun !== undefined) {
      const known = await begun.catch(() => undefined); // whoever has begun may have been told to stop
      signal.throwIfAborted();
      const uses = known && this.#uses.get(known);
      if (known !== undefined && uses !== undefined) {
        this.#uses.set(known, uses + 1);
        return known;
      }
    }
    const storing = this.#store(array, use, signal);
    places.set(place, storing);
    const bytes = await storing;
    if (signal.aborted) {
      bytes.close();
      throw signal.reason;
    }
    this.#uses.set(bytes, 1);
    return bytes;
  }
}
