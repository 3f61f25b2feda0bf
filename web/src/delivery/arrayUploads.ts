// Uploads of the vertex arrays of one patch: each array is stored once, however many attributes read it, and freed when
// the last of them is replaced.

import type { ByVertexRole, VertexRole } from "../stage/attributeRows.ts";
import { vertexRoles } from "../stage/attributeRows.ts";
import type { ElementArray, IndexArray, VertexArray } from "../stage/vertexArray.ts";
import { elementTypeOf } from "../stage/elementType.ts";
import type { ArrayUse, GpuArray, GpuIndex, GpuVertices } from "../stage/stage.ts";

/** Uploads an array to where draws read it. Rejects with the signal's reason; nothing then remains allocated. */
export type StoreBytes = (array: ElementArray, use: ArrayUse, signal: AbortSignal) => Promise<GpuArray>;

export class ArrayUploads {
  readonly #store: StoreBytes;
  /** By buffer, use and byte range: interleaved attributes are views of one buffer. */
  readonly #stored = new WeakMap<ArrayBuffer, Map<string, Promise<GpuArray>>>();
  readonly #useCounts = new Map<GpuArray, number>();
  #retired: GpuArray[] = [];

  constructor(store: StoreBytes) {
    this.#store = store;
  }

  /** Bytes of all arrays that are stored and not freed. */
  get byteLength(): number {
    let sum = 0;
    for (const { byteLength } of this.#useCounts.keys()) sum += byteLength;
    return sum;
  }

  async storeVertices({ array, components, stride, offset }: VertexArray, signal: AbortSignal): Promise<GpuVertices> {
    return {
      bytes: await this.#bytesOf(array, "vertices", signal),
      type: elementTypeOf(array),
      components,
      stride,
      offset,
    };
  }

  async storeAttributes(arrays: ByVertexRole<VertexArray>, signal: AbortSignal): Promise<ByVertexRole<GpuVertices>> {
    const stored: Partial<Record<VertexRole, GpuVertices>> = {};
    await Promise.all(
      vertexRoles.map(async (role) => {
        if (arrays[role] !== undefined) stored[role] = await this.storeVertices(arrays[role], signal);
      }),
    );
    return stored;
  }

  async storeIndex(array: IndexArray, signal: AbortSignal): Promise<GpuIndex> {
    return { bytes: await this.#bytesOf(array, "index", signal), type: elementTypeOf(array) };
  }

  /** The next stage does not use these arrays; to be called once for each. */
  retire(...arrays: readonly ({ readonly bytes: GpuArray } | undefined)[]): void {
    for (const array of arrays) if (array !== undefined) this.#retired.push(array.bytes);
  }

  /** Frees the retired arrays. No stage that uses them may be drawn any more. */
  sweep(): void {
    for (const bytes of this.#retired.splice(0)) {
      const useCount = (this.#useCounts.get(bytes) ?? 0) - 1;
      if (useCount > 0) {
        this.#useCounts.set(bytes, useCount);
      } else {
        this.#useCounts.delete(bytes);
        bytes.close();
      }
    }
  }

  async #bytesOf(array: ElementArray, use: ArrayUse, signal: AbortSignal): Promise<GpuArray> {
    const uploads = this.#stored.get(array.buffer) ?? new Map<string, Promise<GpuArray>>();
    this.#stored.set(array.buffer, uploads);
    const key = `${use} ${array.byteOffset}+${array.byteLength}`;
    const earlierUpload = uploads.get(key);
    if (earlierUpload !== undefined) {
      const stored = await earlierUpload.catch(() => undefined); // the first caller may have been aborted
      signal.throwIfAborted();
      const useCount = stored && this.#useCounts.get(stored);
      if (stored !== undefined && useCount !== undefined) {
        this.#useCounts.set(stored, useCount + 1);
        return stored;
      }
    }
    const upload = this.#store(array, use, signal);
    uploads.set(key, upload);
    const bytes = await upload;
    if (signal.aborted) {
      bytes.close();
      throw signal.reason;
    }
    this.#useCounts.set(bytes, 1);
    return bytes;
  }
}
