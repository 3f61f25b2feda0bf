// X3D's OrthoViewpoint (ISO/IEC 19775-1, 23.4.5) -> a Viewpoint through so long a lens,
// from so far away, that nothing is seen to converge. So one camera serves both,
// with all that moves it, picks through it and asks for files by it.

import type { ViewpointDescription } from "./description.ts";
import type { Vec3 } from "./fieldTypes.ts";
import type { nodeFields, Values } from "./nodes.ts";
import { dot, minus, rotated } from "../tessellate/vectors.ts";

/** Radians: over the depth of what fills the view, sizes differ by 1 %. */
const longLens = 0.01;

/** What is as far as `centerOfRotation` fills the view exactly as the node says. */
export function asViewpoint({
  fieldOfView,
  position,
  orientation,
  centerOfRotation,
  ...values
}: Values<typeof nodeFields.OrthoViewpoint>): ViewpointDescription {
  const [left = -1, bottom = -1, right = 1, top = 1] = fieldOfView;
  const [width, height] = [Math.abs(right - left), Math.abs(top - bottom)];
  const proportion = (width || 2) / (height || 2);
  const half = Math.min(width || 2, height || 2) / 2;
  const axis = (vector: Vec3) => rotated(vector, orientation);
  const [aside, up, back] = [axis([1, 0, 0]), axis([0, 1, 0]), axis([0, 0, 1])];
  const away = half / Math.tan(longLens / 2) - dot(minus(position, centerOfRotation), back);
  const [x, y] = [(left + right) / 2, (bottom + top) / 2];
  const along = (i: 0 | 1 | 2) => position[i] + aside[i] * x + up[i] * y + back[i] * away;
  return {
    ...values,
    orientation,
    centerOfRotation,
    position: [along(0), along(1), along(2)],
    fieldOfView: longLens,
    aspectRatio: proportion,
  };
}
