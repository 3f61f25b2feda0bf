// Compares the filter with vectors/blur.json, which src/containers/blur_test.cpp reads too. With IMGEO_REWRITE_GOLDEN=1
// the results are rewritten from the points.

import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { blurred } from "./blur.ts";

interface Vector {
  name: string;
  columns: number;
  isClosed: boolean;
  radius: number;
  points: number[];
  blurred: number[];
}

const path = join(import.meta.dirname, "../../../../vectors/blur.json");

test("blurred images are those of the vectors", () => {
  const vectors = JSON.parse(readFileSync(path, "utf8")) as Vector[];
  assert.ok(vectors.length >= 7);
  const outputs = vectors.map(({ name, columns, isClosed, radius, points }) => ({
    name,
    columns,
    isClosed,
    radius,
    points,
    blurred: [...blurred({ points, columns, isClosed }, radius)].map((value) => Number(value.toPrecision(12))),
  }));
  if (process.env.IMGEO_REWRITE_GOLDEN === "1")
    writeFileSync(path, `[\n${outputs.map((output) => JSON.stringify(output)).join(",\n")}\n]\n`);
  else assert.deepEqual(outputs, vectors);
});

test("a blur keeps planes and corners, and filters a border along itself", () => {
  const columns = 6;
  const rows = 5;
  const at = (map: (x: number, y: number) => readonly number[]) =>
    Array.from({ length: columns * rows }, (_, n) => map(n % columns, Math.floor(n / columns))).flat();
  const plane = at((x, y) => [x, 2 * x - y, y]);
  blurred({ points: plane, columns, isClosed: false }, 3).forEach((value, i) => {
    assert.ok(Math.abs(value - (plane[i] ?? NaN)) < 1e-12);
  });
  // Two images that meet in a column: what lies beyond it does not change the column.
  const rough = (seed: number) => at((x, y) => [x, Math.sin(x === 0 ? 3 * y : seed * (x + y)), y]);
  const columnOf = (points: readonly number[]) => {
    const result = blurred({ points, columns, isClosed: false }, 2);
    return Array.from({ length: rows }, (_, y) => result[3 * columns * y + 1]);
  };
  assert.deepEqual(columnOf(rough(5)), columnOf(rough(7)));
  assert.equal(columnOf(rough(5))[0], 0);
});
