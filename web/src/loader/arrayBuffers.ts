// Vertex and index arrays for three.js apps. They stay in JavaScript, as in three.js' own
// attributes, so that any renderer can upload them, and restored contexts get them back.

import type { BufferGeometry } from "three";
import { BufferAttribute, InterleavedBuffer } from "three";
import type { ElementArray } from "../stage/vertexArray.ts";
import type { ElementType } from "../stage/elementType.ts";
import { arrayTypeOf, byteSizeOf } from "../stage/elementType.ts";
import type { GpuArray } from "../stage/stage.ts";
import type { BufferProvider } from "../render/uploads/bufferProvider.ts";

interface StoredArray {
  readonly array: ElementArray;
  /** One three.js buffer per element type and stride. */
  readonly records: Map<string, InterleavedBuffer>;
}

export class ArrayBuffers implements BufferProvider {
  readonly #arrays = new WeakMap<GpuArray, StoredArray>();

  store(array: ElementArray): GpuArray {
    const bytes = {
      byteLength: array.byteLength,
      close: () => {
        this.#arrays.delete(bytes);
      },
    };
    this.#arrays.set(bytes, { array, records: new Map() });
    return bytes;
  }

  recordsOf(bytes: GpuArray, type: ElementType, stride: number): InterleavedBuffer {
    const { records } = this.#arrayOf(bytes);
    const key = `${type} ${stride}`;
    const buffer = records.get(key) ?? new InterleavedBuffer(this.#viewOf(bytes, type), stride);
    records.set(key, buffer);
    return buffer;
  }

  indexAttributeOf(bytes: GpuArray, type: ElementType): BufferAttribute {
    return new BufferAttribute(this.#viewOf(bytes, type), 1);
  }

  read(bytes: GpuArray, type: ElementType, first: number, count = Infinity): ElementArray {
    return this.#viewOf(bytes, type).slice(first, first + count);
  }

  dispose(geometry: BufferGeometry): void {
    geometry.dispose();
  }

  #viewOf(bytes: GpuArray, type: ElementType): ElementArray {
    const { array } = this.#arrayOf(bytes);
    return new (arrayTypeOf(type))(array.buffer, array.byteOffset, array.byteLength / byteSizeOf(type));
  }

  #arrayOf(bytes: GpuArray): StoredArray {
    const stored = this.#arrays.get(bytes);
    if (stored === undefined) throw new RangeError("the array is closed");
    return stored;
  }
}
