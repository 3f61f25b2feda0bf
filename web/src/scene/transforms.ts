// Matrices of X3D Transforms and of quantized geometry.

import { Matrix4, Quaternion, Vector3 } from "three";
import type {
  GeometryDescription,
  PatchDescription,
  Rotation,
  TransformDescription,
  Vec3,
} from "../document/description.ts";
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

const [position, size, axis] = [new Vector3(), new Vector3(), new Vector3()];
const [turn, axes] = [new Quaternion(), new Quaternion()];
const [rotationMatrix, axesMatrix, step] = [new Matrix4(), new Matrix4(), new Matrix4()];

/** The matrix of an X3D Transform: T C R SR S -SR -C (ISO/IEC 19775-1, 10.4.4). Written to `target`, which it returns. */
export function matrixOf(transform: TransformDescription, target = new Matrix4()): Matrix4 {
  const { translation, center, rotation, scaleOrientation, scale } = transform;
  setQuaternion(turn, rotation);
  if (isZero(center) && scaleOrientation[3] === 0)
    return target.compose(position.fromArray(translation), turn, size.fromArray(scale));
  setQuaternion(axes, scaleOrientation);
  rotationMatrix.makeRotationFromQuaternion(turn);
  axesMatrix.makeRotationFromQuaternion(axes);
  const [x, y, z] = translation;
  const [cx, cy, cz] = center;
  return target
    .makeTranslation(x + cx, y + cy, z + cz)
    .multiply(rotationMatrix)
    .multiply(axesMatrix)
    .multiply(step.makeScale(...scale))
    .multiply(axesMatrix.invert())
    .multiply(step.makeTranslation(-cx, -cy, -cz));
}

/** As `matrixOf`, where nothing but the translation has changed since `target` was computed. */
export function translate(transform: TransformDescription, target: Matrix4): void {
  const { translation, center, scaleOrientation } = transform;
  if (isZero(center) && scaleOrientation[3] === 0) target.setPosition(translation[0], translation[1], translation[2]);
  else matrixOf(transform, target);
}

function isZero(point: Vec3): boolean {
  return point[0] === 0 && point[1] === 0 && point[2] === 0;
}

/** The identity for an axis without length. */
function setQuaternion(target: Quaternion, rotation: Rotation): Quaternion {
  axis.set(rotation[0], rotation[1], rotation[2]);
  return axis.lengthSq() === 0 ? target.identity() : target.setFromAxisAngle(axis.normalize(), rotation[3]);
}

/** The identity for an axis without length. */
export function rotationOf(rotation: Rotation): Matrix4 {
  return new Matrix4().makeRotationFromQuaternion(setQuaternion(turn, rotation));
}

/** The rotation of a matrix, without its translation and scale; the identity where it flattens. */
export function rotationIn(matrix: Matrix4): Matrix4 {
  if (matrix.determinant() === 0) return new Matrix4();
  const rotation = new Quaternion();
  matrix.decompose(new Vector3(), rotation, new Vector3());
  return new Matrix4().makeRotationFromQuaternion(rotation);
}
