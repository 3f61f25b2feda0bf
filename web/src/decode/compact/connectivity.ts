// The triangles (or lines) of a patch in the order of decoding, and the neighbourhoods that later passes predict from.
// Corner i of triangle t is 3 t + i; -1 means none.

export interface Connectivity {
  /** Per corner. */
  readonly vertex: Int32Array;
  /** Per triangle: the corner opposite of its first edge, in the neighbour there. */
  readonly across: Int32Array;
  /** Per triangle: the same for the second edge that it closes. */
  readonly closing: Int32Array;
  /** Per vertex: those next to it on the boundary when it came. */
  readonly ahead: Int32Array;
  readonly behind: Int32Array;
  /** Per vertex: the corner opposite of the edge on its other side. */
  readonly second: Int32Array;
  /**
   * Triangles only: for each node of the boundary, in the order of creation, the numbers of triangles and
   * nodes when all triangles around it were decoded. Those between two entries are the later node's own.
   */
  readonly fans: Int32Array;
  /** Per vertex, lines: the other end of the line that brought it. */
  readonly from: Int32Array;
}

const nothing = new Int32Array();

/** The connectivity of points. */
export const unconnected: Connectivity = {
  vertex: nothing,
  across: nothing,
  closing: nothing,
  ahead: nothing,
  behind: nothing,
  second: nothing,
  fans: nothing,
  from: nothing,
};

/** The corners of a corner's triangle after and before it, in its orientation. */
export function after(corner: number): number {
  return corner % 3 === 2 ? corner - 2 : corner + 1;
}

export function before(corner: number): number {
  return corner % 3 === 0 ? corner + 2 : corner - 1;
}
