// How a geometry is seen, for deliveries that choose what they request by it.

import type { Camera, Matrix } from "../scheduler/viewMetrics.ts";

/** A camera and the instances of a geometry that it may see. */
export interface GeometryView {
  /** Undefined where there is no single camera. */
  readonly camera: Camera | undefined;
  /** Whether the camera's `pixelsPerUnit` holds at any distance. */
  readonly isOrthographic: boolean;
  readonly instances: Iterable<{ readonly sceneFromShape: Matrix }>;
}
