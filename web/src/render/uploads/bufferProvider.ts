// The interface to vertex and index arrays that are ready for three.js: on the GPU (bufferStore.ts)
// or in JavaScript (loader/arrayBuffers.ts).

import type { ElementType } from "../../stage/elementType.ts";
import type { InterleavedBuffer, BufferAttribute, BufferGeometry } from "three";
import type { StoredBytes } from "../../stage/stage.ts";
import type { ElementArray } from "../../stage/vertexArray.ts";

/** An array that is being uploaded. */
export interface BufferUpload {
  /** Complete after the last step. Closing it frees the buffer, also before that. */
  readonly bytes: StoredBytes;
  /** Each step yields the number of bytes that it has uploaded. */
  readonly steps: Generator<number, void, void>;
}

/** Access to stored arrays. All methods but `dispose` throw RangeError where an array is unknown or closed. */
export interface BufferProvider {
  /** Records of `stride` elements, as three.js' InterleavedBuffer. */
  recordsOf(bytes: StoredBytes, type: ElementType, stride: number): InterleavedBuffer;
  indexOf(bytes: StoredBytes, type: ElementType): BufferAttribute;
  /**
   * `count` elements from element `first` on; all that follow where `count` is undefined. Blocks until the GPU is done
   * where the array is there.
   */
  read(bytes: StoredBytes, type: ElementType, first: number, count?: number): ElementArray;
  /** Disposes of a geometry made from these arrays; the arrays stay. */
  dispose(geometry: BufferGeometry): void;
}
