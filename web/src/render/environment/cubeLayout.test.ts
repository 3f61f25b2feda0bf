import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { cubeLayoutOf } from "./cubeLayout.ts";

/** Left, top, width and height of each side in squares, in the order of OpenGL's faces. */
function squaresOf(columns: number, rows: number) {
  const layout = cubeLayoutOf(64 * columns, 64 * rows);
  assert.ok(layout);
  const { right, left, top, bottom, front, back } = layout;
  return [right, left, top, bottom, front, back].map(([x, y, width, height]) =>
    [x * columns, y * rows, width * columns, height * rows].map(Math.round),
  );
}

const square = (column: number, row: number) => [column, row, 1, 1];

describe("a picture of a cube map", () => {
  test("is a column of right, left, top, bottom, front and back", () => {
    assert.deepEqual(
      squaresOf(1, 6),
      [0, 1, 2, 3, 4, 5].map((row) => square(0, row)),
    );
  });

  test("is a row of the same sides", () => {
    assert.deepEqual(
      squaresOf(6, 1),
      [0, 1, 2, 3, 4, 5].map((column) => square(column, 0)),
    );
  });

  test("is a flat cross, with the back on the right", () => {
    assert.deepEqual(squaresOf(4, 3), [
      square(2, 1),
      square(0, 1),
      square(1, 0),
      square(1, 2),
      square(1, 1),
      square(3, 1),
    ]);
  });

  test("is an upright cross, with the back at the bottom, turned by half a turn", () => {
    assert.deepEqual(squaresOf(3, 4), [
      square(2, 1),
      square(0, 1),
      square(1, 0),
      square(1, 2),
      square(1, 1),
      [2, 4, -1, -1],
    ]);
  });

  test("has no other proportions", () => {
    for (const [width, height] of [
      [64, 64],
      [0, 0],
      [257, 192],
      [384, 63],
    ] as const)
      assert.equal(cubeLayoutOf(width, height), undefined, `${width} x ${height}`);
  });
});
