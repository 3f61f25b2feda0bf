// Applies transforms to the patches of reference pictures.

import { Matrix3, Vector3, type Matrix4 } from "three";
import type { PlainPatch } from "./siteDecoder.ts";

/** The patches transformed by a matrix; if it mirrors, triangles are reversed so that they still face outwards. */
export function transformedPatches(patches: PlainPatch[], matrix: Matrix4): PlainPatch[] {
  const normalMatrix = new Matrix3().getNormalMatrix(matrix);
  const each = (numbers: Float32Array, act: (vector: Vector3) => Vector3): Float32Array =>
    numbers.map((_, i) => act(new Vector3().fromArray(numbers, i - (i % 3))).getComponent(i % 3));
  return patches.map((patch) => ({
    ...patch,
    positions: each(patch.positions, (point) => point.applyMatrix4(matrix)),
    ...(patch.normals && { normals: each(patch.normals, (normal) => normal.applyMatrix3(normalMatrix).normalize()) }),
    triangles: matrix.determinant() > 0 ? patch.triangles : patch.triangles.toReversed(),
  }));
}
