// Axis-aligned boxes as six numbers in one array: the minimum's x, y and z, then the maximum's. A scene may move a
// thousand shapes in every frame, and most of that time is spent on fetching objects that lie apart in memory: a box of
// three.js is nine of them.

import type { Box3, Matrix4 } from "three";
import type { Vec3 } from "../document/description.ts";

/** Empty where the minimum is above the maximum. */
export type FlatBox = Float64Array;

/** GPUs cannot draw beyond this coordinate: squares of lengths must fit into single precision. */
const maxCoordinate = 1e18;

export function makeFlatBox(): FlatBox {
  return makeEmpty(new Float64Array(6));
}

export function flatBoxOf({ min, max }: { readonly min: Vec3; readonly max: Vec3 }): FlatBox {
  return Float64Array.of(...min, ...max);
}

/** Copies a box of three.js to `target`, which it returns. */
export function setFlatBox(target: FlatBox, { min, max }: Readonly<Box3>): FlatBox {
  min.toArray(target, 0);
  max.toArray(target, 3);
  return target;
}

/** Copies a box to one of three.js, `target`, which it returns. */
export function setBox3(target: Box3, box: FlatBox): Box3 {
  target.min.fromArray(box, 0);
  target.max.fromArray(box, 3);
  return target;
}

export function makeEmpty(box: FlatBox): FlatBox {
  return box.fill(Infinity, 0, 3).fill(-Infinity, 3, 6);
}

export function isEmpty(box: FlatBox): boolean {
  return !(number(box, 0) <= number(box, 3) && number(box, 1) <= number(box, 4) && number(box, 2) <= number(box, 5));
}

/** Whether a GPU can draw the content of a box. An empty one has none. */
export function isDrawable(box: FlatBox): boolean {
  for (let i = 0; i < 6; ++i) if (!(Math.abs(number(box, i)) < maxCoordinate)) return false;
  return true;
}

/** Extends `target` to a box. */
export function extend(target: FlatBox, box: FlatBox): void {
  for (let i = 0; i < 3; ++i) {
    if (number(box, i) < number(target, i)) target[i] = number(box, i);
    if (number(box, i + 3) > number(target, i + 3)) target[i + 3] = number(box, i + 3);
  }
}

/** Sets `target` to the bounds of a transformed box. */
export function setTransformed(target: FlatBox, { elements: m }: Matrix4, box: FlatBox): void {
  // A row of the matrix takes its minimum at the corner that has the smaller product along each axis. Without branches
  // by the signs of the factors, which processors cannot foretell where shapes turn.
  const lowX = number(box, 0);
  const lowY = number(box, 1);
  const lowZ = number(box, 2);
  const highX = number(box, 3);
  const highY = number(box, 4);
  const highZ = number(box, 5);
  const { 0: m0, 1: m1, 2: m2, 4: m4, 5: m5, 6: m6, 8: m8, 9: m9, 10: m10, 12: x, 13: y, 14: z } = m;
  target[0] = x + Math.min(m0 * lowX, m0 * highX) + Math.min(m4 * lowY, m4 * highY) + Math.min(m8 * lowZ, m8 * highZ);
  target[3] = x + Math.max(m0 * lowX, m0 * highX) + Math.max(m4 * lowY, m4 * highY) + Math.max(m8 * lowZ, m8 * highZ);
  target[1] = y + Math.min(m1 * lowX, m1 * highX) + Math.min(m5 * lowY, m5 * highY) + Math.min(m9 * lowZ, m9 * highZ);
  target[4] = y + Math.max(m1 * lowX, m1 * highX) + Math.max(m5 * lowY, m5 * highY) + Math.max(m9 * lowZ, m9 * highZ);
  target[2] = z + Math.min(m2 * lowX, m2 * highX) + Math.min(m6 * lowY, m6 * highY) + Math.min(m10 * lowZ, m10 * highZ);
  target[5] = z + Math.max(m2 * lowX, m2 * highX) + Math.max(m6 * lowY, m6 * highY) + Math.max(m10 * lowZ, m10 * highZ);
}

function number(box: FlatBox, i: number): number {
  return box[i] ?? NaN;
}
