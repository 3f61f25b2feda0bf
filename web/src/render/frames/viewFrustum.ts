// The view frustum, for culling.

import { Frustum, Matrix4 } from "three";

/**
 * The frustum in the coordinate system that `viewFromThere` transforms from. `margin`: how far objects may extend
 * beyond their bounds on the screen, as fractions of half the picture's width and height. Wide lines need it: their
 * width is measured on the screen.
 */
export function frustumOf(
  projection: Matrix4,
  viewFromThere: Matrix4,
  [x, y]: readonly [number, number] = [0, 0],
): Frustum {
  const clipFromThere = new Matrix4().multiplyMatrices(projection, viewFromThere);
  return new Frustum().setFromProjectionMatrix(
    clipFromThere.premultiply(new Matrix4().makeScale(1 / (1 + x), 1 / (1 + y), 1)),
  );
}
