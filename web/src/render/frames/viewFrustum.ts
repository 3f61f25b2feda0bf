// Computes the view frustum, for culling.

import { Frustum, Matrix4 } from "three";

/**
 * The frustum in the coordinate system from which `viewFromLocal` transforms. The last argument is how far objects may
 * extend beyond their bounds on the screen, as fractions of half the canvas's width and height. Wide lines need it, as
 * their width is measured on the screen.
 */
export function frustumOf(
  projection: Matrix4,
  viewFromLocal: Matrix4,
  [x, y]: readonly [number, number] = [0, 0],
): Frustum {
  const clipFromLocal = new Matrix4().multiplyMatrices(projection, viewFromLocal);
  return new Frustum().setFromProjectionMatrix(
    clipFromLocal.premultiply(new Matrix4().makeScale(1 / (1 + x), 1 / (1 + y), 1)),
  );
}
