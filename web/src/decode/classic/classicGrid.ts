// Decodes grids of texels on the CPU: writes the vertices, normals and triangles that the vertex shader computes
// without an index (render/shaders/vertexChunk.ts) to arrays for buffers.

import { makeIndex } from "../indexArray.ts";
import type { IndexArray, VertexArray } from "../../stage/vertexArray.ts";
import type { CoordJob } from "./classicArrays.ts";
import { sumsOf } from "./classicArrays.ts";
import type { Grid } from "../../stage/stage.ts";

export interface GridJob extends CoordJob {
  readonly grid: Grid;
  /** Whether the front, to which normals point, is counterclockwise. */
  readonly ccw: boolean;
  /** The stored integer of the far side of the bounding box. */
  readonly maxStored: number;
  /** Lattice step along each axis. */
  readonly step: readonly [number, number, number];
}

export interface GridArrays {
  readonly index: IndexArray;
  readonly coord: VertexArray;
  /** Normals that follow from the slope of the surface. */
  readonly normal: VertexArray;
}

type Vector = [number, number, number];

/** Decodes the coordinates of a grid, and computes its index and normals. */
export async function classicGrid({ grid, ccw, maxStored, step, ...job }: GridJob): Promise<GridArrays> {
  const { columns, rows } = grid;
  const isHeightMap = grid.kind === "heightMap";
  const sums = await sumsOf(job, isHeightMap ? 1 : 3, 3);
  const shift = 256 ** (job.planeCount - job.planes.length);
  const array = new Float32Array(columns * rows * 3);
  for (let record = 0; record < columns * rows; ++record) {
    const stored = (axis: number) => (sums[3 * record + axis] ?? 0) * shift + job.missingBytesMidpoint;
    const point = isHeightMap
      ? [
          ((record % columns) * maxStored) / (columns - 1),
          stored(0),
          (Math.floor(record / columns) * maxStored) / (rows - 1),
        ]
      : [stored(0), stored(1), stored(2)];
    array.set(point, 3 * record);
  }
  return {
    index: gridIndex(grid),
    coord: { array, components: 3, stride: 3, offset: 0 },
    normal: { array: slopeNormals(array, grid, step, ccw ? 1 : -1), components: 3, stride: 3, offset: 0 },
  };
}

/** Two triangles for each cell, counterclockwise where columns run to the right and rows down. */
export function gridIndex({ kind, columns, rows }: Grid): IndexArray {
  const cellsAcross = kind === "sculpt" ? columns : columns - 1;
  const count = 6 * cellsAcross * (rows - 1);
  const index = makeIndex(columns * rows, count);
  let at = 0;
  for (let row = 0; row + 1 < rows; ++row) {
    for (let column = 0; column < cellsAcross; ++column) {
      const here = row * columns + column;
      const right = row * columns + ((column + 1) % columns);
      index.set([here, here + columns, right, here + columns, right + columns, right], at);
      at += 6;
    }
  }
  return index;
}

/** Normals of the surface, from central differences. */
function slopeNormals(
  points: Float32Array,
  { kind, columns, rows }: Grid,
  step: readonly number[],
  side: 1 | -1,
): Float32Array<ArrayBuffer> {
  const isClosed = kind === "sculpt";
  const normals = new Float32Array(points.length);
  const at = (row: number, column: number, axis: number) => points[3 * (row * columns + column) + axis] ?? 0;
  const normalAt = (row: number, column: number): Vector => {
    const left = isClosed ? (column + columns - 1) % columns : Math.max(column - 1, 0);
    const right = isClosed ? (column + 1) % columns : Math.min(column + 1, columns - 1);
    const [above, below] = [Math.max(row - 1, 0), Math.min(row + 1, rows - 1)];
    const across = [0, 1, 2].map((axis) => at(row, right, axis) - at(row, left, axis)) as Vector;
    const down = [0, 1, 2].map((axis) => at(below, column, axis) - at(above, column, axis)) as Vector;
    return cross(down, across).map((component, axis) => (side * component) / (step[axis] ?? 1)) as Vector;
  };
  for (let row = 0; row < rows; ++row) {
    for (let column = 0; column < columns; ++column) {
      let normal = normalAt(row, column);
      // At a pole all points of a row coincide; the normals are then those of the next row.
      if (normal.every((component) => component === 0)) normal = normalAt(row === 0 ? 1 : row - 1, column);
      const length = Math.hypot(...normal) || 1;
      normals.set(
        normal.map((component) => component / length),
        3 * (row * columns + column),
      );
    }
  }
  return normals;
}

function cross(a: Vector, b: Vector): Vector {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}
