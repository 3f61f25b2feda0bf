// Affine transforms as lists of 16 numbers, column by column.

import type { Quaternion } from "../rotations.ts";
import type { Point } from "../rays.ts";

export type Matrix = ArrayLike<number>;

function at(matrix: Matrix, row: number, column: number): number {
  return matrix[4 * column + row] ?? 0;
}

export function transformPoint(matrix: Matrix, [x, y, z]: Point): Point {
  const row = (r: number): number =>
    at(matrix, r, 0) * x + at(matrix, r, 1) * y + at(matrix, r, 2) * z + at(matrix, r, 3);
  return [row(0), row(1), row(2)];
}

export function transformDirection(matrix: Matrix, [x, y, z]: Point): Point {
  const row = (r: number): number => at(matrix, r, 0) * x + at(matrix, r, 1) * y + at(matrix, r, 2) * z;
  return [row(0), row(1), row(2)];
}

/** A normal in the coordinates that the matrix maps from, of length 1. */
export function normalBefore(matrix: Matrix, [x, y, z]: Point): Point {
  const column = (c: number): number => at(matrix, 0, c) * x + at(matrix, 1, c) * y + at(matrix, 2, c) * z;
  const normal: Point = [column(0), column(1), column(2)];
  const length = Math.hypot(...normal) || 1;
  return [normal[0] / length, normal[1] / length, normal[2] / length];
}

/** Undefined for a matrix that flattens. */
export function inverseOf(matrix: Matrix): number[] | undefined {
  const m = (row: number, column: number): number => at(matrix, row, column);
  const cofactor = (r: number, c: number): number => {
    const [a, b] = [(r + 1) % 3, (r + 2) % 3];
    const [d, e] = [(c + 1) % 3, (c + 2) % 3];
    return m(a, d) * m(b, e) - m(a, e) * m(b, d);
  };
  const determinant = m(0, 0) * cofactor(0, 0) + m(0, 1) * cofactor(0, 1) + m(0, 2) * cofactor(0, 2);
  if (determinant === 0 || !Number.isFinite(determinant)) return undefined;
  const inverse = new Array<number>(16).fill(0);
  for (let row = 0; row < 3; row++) {
    let offset = 0;
    for (let column = 0; column < 3; column++) {
      const value = cofactor(column, row) / determinant;
      inverse[4 * column + row] = value;
      offset -= value * m(column, 3);
    }
    inverse[12 + row] = offset;
  }
  inverse[15] = 1;
  return inverse;
}

/** a · b. */
export function product(a: Matrix, b: Matrix): number[] {
  const result = new Array<number>(16);
  for (let column = 0; column < 4; column++)
    for (let row = 0; row < 4; row++) {
      let sum = 0;
      for (let i = 0; i < 4; i++) sum += at(a, row, i) * at(b, i, column);
      result[4 * column + row] = sum;
    }
  return result;
}

/** The rotation of a matrix without shear; its scale does not count. */
export function rotationIn(matrix: Matrix): Quaternion {
  const lengths = [0, 1, 2].map((c) => Math.hypot(at(matrix, 0, c), at(matrix, 1, c), at(matrix, 2, c)) || 1);
  const m = (row: number, column: number): number => at(matrix, row, column) / (lengths[column] ?? 1);
  const trace = m(0, 0) + m(1, 1) + m(2, 2);
  if (trace > 0) {
    const s = 2 * Math.sqrt(trace + 1);
    return [(m(2, 1) - m(1, 2)) / s, (m(0, 2) - m(2, 0)) / s, (m(1, 0) - m(0, 1)) / s, s / 4];
  }
  const i = m(0, 0) > m(1, 1) && m(0, 0) > m(2, 2) ? 0 : m(1, 1) > m(2, 2) ? 1 : 2;
  const [j, k] = [(i + 1) % 3, (i + 2) % 3];
  const s = 2 * Math.sqrt(1 + m(i, i) - m(j, j) - m(k, k));
  const q: [number, number, number, number] = [0, 0, 0, (m(k, j) - m(j, k)) / s];
  q[i] = s / 4;
  q[j] = (m(j, i) + m(i, j)) / s;
  q[k] = (m(k, i) + m(i, k)) / s;
  return q;
}
