// Matrices of X3D Transforms and of quantized geometry.

import { Matrix4, Quaternion, Vector3 } from "three";
import type { GeometryDescription, PatchDescription, Rotation, TransformDescription } from "../document/description.ts";
import { dequantizationOf } from "../document/dequantization.ts";

/** The mean factor by which a matrix scales lengths; 1 for a singular matrix. */
export function lengthScaleOf(matrix: Matrix4): number {
  return Math.cbrt(Math.abs(matrix.determinant())) || 1;
}

/** Maps stored integers to shape coordinates. */
export function shapeFromStoredOf(geometry: GeometryDescription, patch: PatchDescription): Matrix4 {
  const { origin, step } = dequantizationOf(geometry, patch);
  return new Matrix4().makeScale(...step).setPosition(...origin);
}

/** The matrix of an X3D Transform: T C R SR S -SR -C (ISO/IEC 19775-1, 10.4.4). */
export function matrixOf(transform: TransformDescription): Matrix4 {
  const { translation, center, rotation, scaleOrientation, scale } = transform;
  if (isZero(center) && scaleOrientation[3] === 0) {
    return new Matrix4().compose(new Vector3(...translation), quaternionOf(rotation), new Vector3(...scale));
  }
  const rotationMatrix = rotationOf(rotation);
  const scaleAxes = rotationOf(scaleOrientation);
  const translate = (vector: readonly [number, number, number], sign: number) =>
    new Matrix4().makeTranslation(vector[0] * sign, vector[1] * sign, vector[2] * sign);
  return translate(translation, 1)
    .multiply(translate(center, 1))
    .multiply(rotationMatrix)
    .multiply(scaleAxes)
    .multiply(new Matrix4().makeScale(...scale))
    .multiply(scaleAxes.clone().invert())
    .multiply(translate(center, -1));
}

function isZero([x, y, z]: readonly [number, number, number]): boolean {
  return x === 0 && y === 0 && z === 0;
}

function quaternionOf([x, y, z, angle]: Rotation): Quaternion {
  const axis = new Vector3(x, y, z);
  return axis.lengthSq() === 0 ? new Quaternion() : new Quaternion().setFromAxisAngle(axis.normalize(), angle);
}

/** The identity for an axis without length. */
export function rotationOf(rotation: Rotation): Matrix4 {
  return new Matrix4().makeRotationFromQuaternion(quaternionOf(rotation));
}

/** The rotation of a matrix, without its translation and scale; the identity where it flattens. */
export function rotationIn(matrix: Matrix4): Matrix4 {
  if (matrix.determinant() === 0) return new Matrix4();
  const rotation = new Quaternion();
  matrix.decompose(new Vector3(), rotation, new Vector3());
  return new Matrix4().makeRotationFromQuaternion(rotation);
}
