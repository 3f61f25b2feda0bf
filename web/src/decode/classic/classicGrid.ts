// Decodes grids of texels on the CPU: writes the vertices, normals and triangles that the vertex shader computes
// without an index (render/shaders/vertexChunk.ts) to arrays for buffers.

import { makeIndex } from "../indexArray.ts";
import { gridNormals } from "../vertexNormals.ts";
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

/** Decodes the coordinates of a grid, and computes its index and normals. */
export async function classicGrid({ grid, ccw, maxStored, step, ...job }: GridJob): Promise<GridArrays> {
  const { columns, rows, part = { column: 0, row: 0, columns, rows } } = grid;
  const isHeightMap = grid.kind === "heightMap";
  const sums = await sumsOf(job, isHeightMap ? 1 : 3, 3);
  const shift = 256 ** (job.planeCount - job.planes.length);
  const array = new Float32Array(columns * rows * 3);
  for (let record = 0; record < columns * rows; ++record) {
    const stored = (axis: number) => (sums[3 * record + axis] ?? 0) * shift + job.missingBytesMidpoint;
    const point = isHeightMap
      ? [
          ((part.column + (record % columns)) * maxStored) / (part.columns - 1),
          stored(0),
          ((part.row + Math.floor(record / columns)) * maxStored) / (part.rows - 1),
        ]
      : [stored(0), stored(1), stored(2)];
    array.set(point, 3 * record);
  }
  return {
    index: gridIndex(grid),
    coord: { array, components: 3, stride: 3, offset: 0 },
    normal: { array: gridNormals({ array, stride: 3 }, grid, step, ccw ? 1 : -1), components: 3, stride: 3, offset: 0 },
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
