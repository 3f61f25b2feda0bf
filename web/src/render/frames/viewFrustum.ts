// What a camera sees: for leaving out what it does not.

import { Frustum, Matrix4 } from "three";

/**
 * In the coordinates that `viewFromThere` leads from. `margin`: how far what is drawn
 * may reach beyond its bounds, as shares of half the picture's width and height; wide
 * lines are wide on the screen, wherever they are.
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
