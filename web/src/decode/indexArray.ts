// Index arrays of the smallest type that WebGL 2 draws correctly.

/** WebGL 2 restarts a strip at the index 65535 of Uint16 arrays, so that this index is not a vertex. */
const maxUint16VertexCount = 65535;

/** An array of `length` vertex indices, each below `vertexCount`. */
export function makeIndex(vertexCount: number, length: number): Uint16Array<ArrayBuffer> | Uint32Array<ArrayBuffer> {
  return vertexCount <= maxUint16VertexCount ? new Uint16Array(length) : new Uint32Array(length);
}
