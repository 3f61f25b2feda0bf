// Normals of vertices that come without them: from the slope of a grid, as the vertex shader computes them
// (render/shaders/vertexChunk.ts), or from the triangles around each vertex.

import type { ElementArray, IndexArray } from "../stage/vertexArray.ts";
import type { Grid } from "../stage/stage.ts";

/** Points as x y z at the beginning of every `stride` elements. */
export interface Points {
  readonly array: ElementArray;
  readonly stride: number;
}

type Normals = Float32Array<ArrayBuffer>;

/**
 * Unit normals of a grid, from the differences between the neighbours on both sides of each vertex; at a border, the
 * vertex itself is one of them. `step`: the lattice step along each axis. `side`: -1 where the front is clockwise.
 */
export function gridNormals(points: Points, grid: Grid, step: readonly number[], side: 1 | -1): Normals {
  const { array, stride } = points;
  const { kind, columns, rows } = grid;
  const isClosed = kind === "sculpt";
  const normals = new Float32Array(3 * columns * rows);
  const [stepX = 1, stepY = 1, stepZ = 1] = step;
  /** Writes the normal at a vertex of the grid to `target`; false where all its neighbours are one point. */
  const writeNormal = (row: number, column: number, target: number): boolean => {
    const left = isClosed ? (column + columns - 1) % columns : Math.max(column - 1, 0);
    const right = isClosed ? (column + 1) % columns : Math.min(column + 1, columns - 1);
    const [l, r] = [stride * (row * columns + left), stride * (row * columns + right)];
    const a = stride * (Math.max(row - 1, 0) * columns + column);
    const b = stride * (Math.min(row + 1, rows - 1) * columns + column);
    const acrossX = (array[r] ?? 0) - (array[l] ?? 0);
    const acrossY = (array[r + 1] ?? 0) - (array[l + 1] ?? 0);
    const acrossZ = (array[r + 2] ?? 0) - (array[l + 2] ?? 0);
    const downX = (array[b] ?? 0) - (array[a] ?? 0);
    const downY = (array[b + 1] ?? 0) - (array[a + 1] ?? 0);
    const downZ = (array[b + 2] ?? 0) - (array[a + 2] ?? 0);
    const x = (side * (downY * acrossZ - downZ * acrossY)) / stepX;
    const y = (side * (downZ * acrossX - downX * acrossZ)) / stepY;
    const z = (side * (downX * acrossY - downY * acrossX)) / stepZ;
    return writeUnit(normals, target, x, y, z);
  };
  for (let row = 0, target = 0; row < rows; ++row) {
    for (let column = 0; column < columns; ++column, target += 3) {
      // At a pole all points of a row coincide; the normals are then those of the next row.
      if (!writeNormal(row, column, target)) writeNormal(row === 0 ? 1 : row - 1, column, target);
    }
  }
  return normals;
}

/**
 * Unit normals of vertices: the sum of the normals of their triangles, each as long as twice the triangle's area. The
 * front of triangles is counterclockwise. A vertex of no triangle with an area has the normal 0 0 1.
 */
export function triangleNormals({ array, stride }: Points, vertexCount: number, triangles: IndexArray): Normals {
  // Sums of products of differences of integers below 2^24: floats of 32 bits would lose small triangles.
  const sums = new Float64Array(3 * vertexCount);
  // Plain variables: arrays that are taken apart at once double the time.
  for (let corner = 0; corner + 2 < triangles.length; corner += 3) {
    const i = triangles[corner] ?? 0;
    const j = triangles[corner + 1] ?? 0;
    const k = triangles[corner + 2] ?? 0;
    const p = stride * i;
    const q = stride * j;
    const r = stride * k;
    const px = array[p] ?? 0;
    const py = array[p + 1] ?? 0;
    const pz = array[p + 2] ?? 0;
    const ux = (array[q] ?? 0) - px;
    const uy = (array[q + 1] ?? 0) - py;
    const uz = (array[q + 2] ?? 0) - pz;
    const vx = (array[r] ?? 0) - px;
    const vy = (array[r + 1] ?? 0) - py;
    const vz = (array[r + 2] ?? 0) - pz;
    const x = uy * vz - uz * vy;
    const y = uz * vx - ux * vz;
    const z = ux * vy - uy * vx;
    addTo(sums, 3 * i, x, y, z);
    addTo(sums, 3 * j, x, y, z);
    addTo(sums, 3 * k, x, y, z);
  }
  const normals = new Float32Array(3 * vertexCount);
  for (let at = 0; at < normals.length; at += 3) {
    if (!writeUnit(normals, at, sums[at] ?? 0, sums[at + 1] ?? 0, sums[at + 2] ?? 0)) normals[at + 2] = 1;
  }
  return normals;
}

function addTo(sums: Float64Array, at: number, x: number, y: number, z: number): void {
  sums[at] = (sums[at] ?? 0) + x;
  sums[at + 1] = (sums[at + 1] ?? 0) + y;
  sums[at + 2] = (sums[at + 2] ?? 0) + z;
}

/** Writes the unit vector in this direction; returns false, and writes nothing, for the null vector. */
function writeUnit(target: Normals, at: number, x: number, y: number, z: number): boolean {
  const length = Math.sqrt(x * x + y * y + z * z);
  if (length === 0) return false;
  target[at] = x / length;
  target[at + 1] = y / length;
  target[at + 2] = z / length;
  return true;
}
