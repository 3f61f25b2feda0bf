// Compares grids with vectors/grids.json, which src/containers/grid_test.cpp reads too. With IMGEO_REWRITE_GOLDEN=1 the
// points, normals and indices are rewritten from the images.

import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import type { GridPart } from "../../stage/stage.ts";
import { pngWithTexels } from "../png.testing.ts";
import { classicGrid } from "./classicGrid.ts";

interface Vector {
  name: string;
  kind: "heightMap" | "geometryImage" | "sculpt";
  columns: number;
  rows: number;
  /** Undefined: the grid is the whole height map. */
  part?: GridPart;
  ccw: boolean;
  position: [number, number, number];
  size: [number, number, number];
  /** Width of the images; at least `columns`. */
  width: number;
  channels: 1 | 3;
  /** Bytes of each image, the most significant first. */
  planes: number[][];
  points: number[];
  normals: number[];
  /** Without triangles that have two corners at one point: only the C++ reader leaves them out. */
  index: number[];
}

const path = join(import.meta.dirname, "../../../../vectors/grids.json");

async function outputOf({ kind, columns, rows, part, ccw, position, size, width, channels, planes }: Vector) {
  const maxStored = 256 ** planes.length - 1;
  const pixels = (bytes: number[]) =>
    pngWithTexels(width, rows, channels, (n, channel) => bytes[channels * n + channel] ?? assert.fail("too few bytes"));
  const { coord, normal, index } = await classicGrid({
    planes: planes.map((bytes) => ({ bytes: pixels(bytes), firstTexel: 0 })),
    planeCount: planes.length,
    missingBytesMidpoint: 0,
    count: columns * rows,
    rowLength: columns,
    grid: { kind, columns, rows, part },
    ccw,
    maxStored,
    step: [size[0] / maxStored, size[1] / maxStored, size[2] / maxStored],
  });
  const stored = [...coord.array];
  const pointOf = (n: number) => stored.slice(3 * n, 3 * n + 3).join();
  const triangles = Array.from({ length: index.length / 3 }, (_, n) => [...index.slice(3 * n, 3 * n + 3)]);
  return {
    points: stored.map((value, n) => {
      const axis = (n % 3) as 0 | 1 | 2;
      return position[axis] + size[axis] * (value / maxStored - 0.5);
    }),
    normals: [...normal.array],
    index: triangles.filter((corners) => new Set(corners.map(pointOf)).size === 3).flat(),
  };
}

test("grids of height maps, geometry images and sculpts are those of the vectors", async () => {
  const vectors = JSON.parse(readFileSync(path, "utf8")) as Vector[];
  assert.ok(vectors.length >= 5);
  const rows: string[] = [];
  for (const vector of vectors) {
    const output = await outputOf(vector);
    const short = (numbers: number[]) => numbers.map((value) => Number(value.toPrecision(7)));
    rows.push(
      JSON.stringify({
        ...vector,
        points: short(output.points),
        normals: short(output.normals),
        index: output.index,
      }),
    );
    if (process.env.IMGEO_REWRITE_GOLDEN !== undefined) continue;
    assert.deepEqual(output.index, vector.index, vector.name);
    for (const key of ["points", "normals"] as const) {
      assert.equal(output[key].length, vector[key].length);
      for (const [n, value] of output[key].entries())
        assert.ok(Math.abs(value - (vector[key][n] ?? NaN)) < 1e-5, `${vector.name}: ${key} ${n}`);
    }
  }
  if (process.env.IMGEO_REWRITE_GOLDEN !== undefined) writeFileSync(path, `[\n${rows.join(",\n")}\n]\n`);
});
