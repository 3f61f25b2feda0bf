// Typed arrays of vertex data, as decoders make them.

export type ElementArray =
  | Int8Array<ArrayBuffer>
  | Uint8Array<ArrayBuffer>
  | Int16Array<ArrayBuffer>
  | Uint16Array<ArrayBuffer>
  | Int32Array<ArrayBuffer>
  | Uint32Array<ArrayBuffer>
  | Float32Array<ArrayBuffer>;

/** One group of `stride` elements a vertex, of which `components` from `offset` on count. */
export interface VertexArray {
  readonly array: ElementArray;
  readonly components: 1 | 2 | 3 | 4;
  /** In elements, as `offset`. */
  readonly stride: number;
  readonly offset: number;
}

export type IndexArray = Uint8Array<ArrayBuffer> | Uint16Array<ArrayBuffer> | Uint32Array<ArrayBuffer>;

type Triple = readonly [number, number, number];

export interface Bounds {
  readonly min: Triple;
  readonly max: Triple;
}
