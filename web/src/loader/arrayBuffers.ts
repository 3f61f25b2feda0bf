// Vertex and index arrays for three.js apps. They stay in JavaScript, as in three.js' own
// attributes, so that any renderer can upload them, and restored contexts get them back.

import type { BufferGeometry, Usage } from "three";
import { BufferAttribute, DynamicDrawUsage, InterleavedBuffer, StaticDrawUsage } from "three";
import type { ElementArray } from "../stage/vertexArray.ts";
import type { ElementType } from "../stage/elementType.ts";
import { arrayTypeOf, byteSizeOf } from "../stage/elementType.ts";
import type { GpuArray, WritableArray } from "../stage/stage.ts";
import type { BufferProvider } from "../render/uploads/bufferProvider.ts";

interface StoredArray {
  readonly array: ElementArray;
  readonly usage: Usage;
  /** One three.js buffer per element type and stride. */
  readonly records: Map<string, InterleavedBuffer>;
}

export class ArrayBuffers implements BufferProvider {
  readonly ownsBuffers = false; // three.js makes a buffer for each attribute, and frees it with the geometry
  readonly #arrays = new WeakMap<GpuArray, StoredArray>();

  store(array: ElementArray, usage: Usage = StaticDrawUsage): GpuArray {
    const gpuArray = {
      byteLength: array.byteLength,
      close: () => {
        this.#arrays.delete(gpuArray);
      },
    };
    this.#arrays.set(gpuArray, { array, usage, records: new Map() });
    return gpuArray;
  }

  /** Stores a copy of vertices; `write` of the result replaces their values in the same array. */
  makeWritable(array: ElementArray): WritableArray {
    const bytes = Object.assign(this.store(array.slice(), DynamicDrawUsage), { version: 0 });
    return {
      bytes,
      write: (elements) => {
        const stored = this.#arrays.get(bytes);
        stored?.array.set(elements);
        bytes.version += 1;
        for (const buffer of stored?.records.values() ?? []) buffer.needsUpdate = true;
      },
    };
  }

  recordsOf(gpuArray: GpuArray, type: ElementType, stride: number): InterleavedBuffer {
    const { records, usage } = this.#arrayOf(gpuArray);
    const key = `${type} ${stride}`;
    const buffer = records.get(key) ?? new InterleavedBuffer(this.#viewOf(gpuArray, type), stride).setUsage(usage);
    records.set(key, buffer);
    return buffer;
  }

  indexAttributeOf(gpuArray: GpuArray, type: ElementType): BufferAttribute {
    return new BufferAttribute(this.#viewOf(gpuArray, type), 1);
  }

  read(gpuArray: GpuArray, type: ElementType, first: number, count = Infinity): ElementArray {
    return this.#viewOf(gpuArray, type).slice(first, first + count);
  }

  dispose(geometry: BufferGeometry): void {
    geometry.dispose();
  }

  #viewOf(gpuArray: GpuArray, type: ElementType): ElementArray {
    const { array } = this.#arrayOf(gpuArray);
    return new (arrayTypeOf(type))(array.buffer, array.byteOffset, array.byteLength / byteSizeOf(type));
  }

  #arrayOf(gpuArray: GpuArray): StoredArray {
    const stored = this.#arrays.get(gpuArray);
    if (stored === undefined) throw new RangeError("the array is closed");
    return stored;
  }
}
