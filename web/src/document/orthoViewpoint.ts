// Replaces X3D's OrthoViewpoint (ISO/IEC 19775-1, 23.4.5) by a distant perspective Viewpoint with so small a field of
// view that no convergence is visible. So navigation, picking and file priorities need perspective cameras only.

import type { ViewpointDescription } from "./description.ts";
import type { Vec3 } from "./fieldTypes.ts";
import type { nodeFields, Values } from "./nodes.ts";
import { dot, minus, rotated } from "../tessellate/vectors.ts";

/** Radians: sizes differ by 1 % over a depth equal to the extent of the view. */
const narrowFieldOfView = 0.01;

/** At the distance of `centerOfRotation`, the view shows exactly the node's field of view. */
export function asViewpoint({
  fieldOfView,
  position,
  orientation,
  centerOfRotation,
  ...values
}: Values<typeof nodeFields.OrthoViewpoint>): ViewpointDescription {
  const [left = -1, bottom = -1, right = 1, top = 1] = fieldOfView;
  const [width, height] = [Math.abs(right - left), Math.abs(top - bottom)];
  const aspectRatio = (width || 2) / (height || 2);
  const halfExtent = Math.min(width || 2, height || 2) / 2;
  const axis = (vector: Vec3) => rotated(vector, orientation);
  const [xAxis, yAxis, zAxis] = [axis([1, 0, 0]), axis([0, 1, 0]), axis([0, 0, 1])];
  const distance = halfExtent / Math.tan(narrowFieldOfView / 2) - dot(minus(position, centerOfRotation), zAxis);
  const [x, y] = [(left + right) / 2, (bottom + top) / 2];
  const coordinateAlong = (i: 0 | 1 | 2) => position[i] + xAxis[i] * x + yAxis[i] * y + zAxis[i] * distance;
  return {
    ...values,
    orientation,
    centerOfRotation,
    position: [coordinateAlong(0), coordinateAlong(1), coordinateAlong(2)],
    fieldOfView: narrowFieldOfView,
    aspectRatio,
  };
}
