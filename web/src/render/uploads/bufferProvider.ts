import type { ElementType } from "../../stage/elementType.ts";
import type { InterleavedBuffer, BufferAttribute, BufferGeometry } from "three";
import type { StoredBytes } from "../../stage/stage.ts";
import type { ElementArray } from "../../stage/vertexArray.ts";

/** An array on its way to the GPU. */
export interface BufferUpload {
  /** Complete after the last step; closing it frees the buffer at any time. */
  readonly bytes: StoredBytes;
  /** Each step yields the bytes that it has moved. */
  readonly steps: Generator<number, void, void>;
}

/** Where arrays are that have been stored. Throws RangeError where one is not, or is closed. */
export interface BufferProvider {
  /** Records of `stride` elements, for three.js. */
  recordsOf(bytes: StoredBytes, type: ElementType, stride: number): InterleavedBuffer;
  indexOf(bytes: StoredBytes, type: ElementType): BufferAttribute;
  /** `count` elements from number `first` on; all that follow where `count` is undefined. Waits for the GPU where it has them. */
  read(bytes: StoredBytes, type: ElementType, first: number, count?: number): ElementArray;
  /** Disposes of a geometry that was made of these; they themselves stay. */
  dispose(geometry: BufferGeometry): void;
}
