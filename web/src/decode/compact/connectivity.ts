// The triangles (or lines) of a patch in the order of decoding, and the neighbourhoods that later passes predict from.
// Corner i of triangle t is 3 t + i; -1 means none.

export interface Connectivity {
  /** Per corner. */
  readonly vertex: Int32Array;
  /** Per triangle: the corner opposite its first edge, in the triangle across that edge. */
  readonly across: Int32Array;
  /** Per triangle: the same for its second edge, where it closes onto an existing triangle there. */
  readonly closing: Int32Array;
  /** Per vertex, on the boundary when it was decoded: the vertex after its next, and the one before its previous. */
  readonly ahead: Int32Array;
  readonly behind: Int32Array;
  /** Per vertex: the apex behind the edge of the triangle that closes its other side. */
  readonly second: Int32Array;
  /**
   * Triangles only: for each node of the boundary, in the order of creation, the counts of triangles and of nodes when
   * all triangles around it were decoded. The fan of a node is the triangles from the entry before it to its own.
   */
  readonly fans: Int32Array;
  /** Lines only, per vertex: the other end of the line that it was decoded with. */
  readonly from: Int32Array;
}

const empty = new Int32Array();

/** The connectivity of points. */
export const unconnected: Connectivity = {
  vertex: empty,
  across: empty,
  closing: empty,
  ahead: empty,
  behind: empty,
  second: empty,
  fans: empty,
  from: empty,
};

/** The next corner of the same triangle, in its orientation. */
export function after(corner: number): number {
  return corner % 3 === 2 ? corner - 2 : corner + 1;
}

/** The previous corner of the same triangle, in its orientation. */
export function before(corner: number): number {
  return corner % 3 === 0 ? corner + 2 : corner - 1;
}
