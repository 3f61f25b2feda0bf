// The interface to stored vertex and index arrays, which three.js can draw. They are on the GPU
// (bufferStore.ts) or in JavaScript (loader/arrayBuffers.ts).

import type { ElementType } from "../../stage/elementType.ts";
import type { InterleavedBuffer, BufferAttribute, BufferGeometry } from "three";
import type { GpuArray } from "../../stage/stage.ts";
import type { ElementArray } from "../../stage/vertexArray.ts";

/** An array that is being uploaded. */
export interface BufferUpload {
  /** Complete after the last step. Closing it frees the buffer, even before the last step. */
  readonly bytes: GpuArray;
  /** Each step yields the number of bytes that it has uploaded. */
  readonly steps: Generator<number, void, void>;
}

/** Access to stored arrays. All methods but `dispose` throw RangeError if an array is unknown or closed. */
export interface BufferProvider {
  /**
   * Whether buffers on the GPU belong to stored arrays, so that the attributes of a geometry can be exchanged;
   * otherwise they belong to geometries.
   */
  readonly ownsBuffers: boolean;
  /** Records of `stride` elements, as three.js' InterleavedBuffer. */
  recordsOf(bytes: GpuArray, type: ElementType, stride: number): InterleavedBuffer;
  /** The whole array, as the index of a geometry. */
  indexAttributeOf(bytes: GpuArray, type: ElementType): BufferAttribute;
  /**
   * Returns `count` elements from element `first` on; all that follow if `count` is undefined. If the array is on the
   * GPU, blocks until the GPU is done.
   */
  read(bytes: GpuArray, type: ElementType, first: number, count?: number): ElementArray;
  /** Disposes of a geometry made from these arrays; the arrays stay. */
  dispose(geometry: BufferGeometry): void;
}
