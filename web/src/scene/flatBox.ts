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
  // A row of the matrix takes its minimum at the corner that has the smaller product along each axis.
  const lowX = number(box, 0);
  const lowY = number(box, 1);
  const lowZ = number(box, 2);
  const highX = number(box, 3);
  const highY = number(box, 4);
  const highZ = number(box, 5);
  const { 0: m0, 1: m1, 2: m2, 4: m4, 5: m5, 6: m6, 8: m8, 9: m9, 10: m10, 12: x, 13: y, 14: z } = m;
  target[0] = x + productBySign(m0, lowX, highX) + productBySign(m4, lowY, highY) + productBySign(m8, lowZ, highZ);
  target[3] = x + productBySign(m0, highX, lowX) + productBySign(m4, highY, lowY) + productBySign(m8, highZ, lowZ);
  target[1] = y + productBySign(m1, lowX, highX) + productBySign(m5, lowY, highY) + productBySign(m9, lowZ, highZ);
  target[4] = y + productBySign(m1, highX, lowX) + productBySign(m5, highY, lowY) + productBySign(m9, highZ, lowZ);
  target[2] = z + productBySign(m2, lowX, highX) + productBySign(m6, lowY, highY) + productBySign(m10, lowZ, highZ);
  target[5] = z + productBySign(m2, highX, lowX) + productBySign(m6, highY, lowY) + productBySign(m10, highZ, lowZ);
}

/** A factor times one of two numbers: the first where the factor is not negative, otherwise the second. */
function productBySign(factor: number, ifPositive: number, ifNegative: number): number {
  return factor * (factor >= 0 ? ifPositive : ifNegative);
}

function number(box: FlatBox, i: number): number {
  return box[i] ?? NaN;
}
