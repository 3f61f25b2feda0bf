// Typed arrays of vertex data, as decoders produce them.

export type ElementArray =
  | Int8Array<ArrayBuffer>
  | Uint8Array<ArrayBuffer>
  | Int16Array<ArrayBuffer>
  | Uint16Array<ArrayBuffer>
  | Int32Array<ArrayBuffer>
  | Uint32Array<ArrayBuffer>
  | Float32Array<ArrayBuffer>;

/** `stride` elements for each vertex, of which `components` from `offset` on are used. */
export interface VertexArray {
  readonly array: ElementArray;
  readonly components: 1 | 2 | 3 | 4;
  /** Both in elements. */
  readonly stride: number;
  readonly offset: number;
}

export type IndexArray = Uint8Array<ArrayBuffer> | Uint16Array<ArrayBuffer> | Uint32Array<ArrayBuffer>;

type Triple = readonly [number, number, number];

export interface Bounds {
  readonly min: Triple;
  readonly max: Triple;
}
