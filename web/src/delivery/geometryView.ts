// How a geometry is seen, for deliveries that choose what they request by it.

import type { SceneView } from "../levels/levelViews.ts";
import type { Matrix, Point } from "../scheduler/viewMetrics.ts";

/** What levels of detail are refined for. */
export interface LevelDemand {
  /** Empty where no camera is known. */
  readonly views: readonly SceneView[];
  /** GPU memory in bytes of the whole scene, beyond which they are not refined. */
  readonly maxBytes: number;
}

/** The state of meshes with levels of detail. */
export interface LevelStatistics {
  /** Groups that are on the GPU. */
  readonly groups: number;
  /** Groups that are refined to: their own triangles are drawn, but for those that their children replace. */
  readonly openGroups: number;
  /** GPU memory of all groups. */
  readonly bytes: number;
  /**
   * The largest stated error of what is drawn, in pixels of the canvas: at most 1 when nothing is missing for the view
   * and the memory suffices. 0 where no camera is known or nothing is drawn yet.
   */
  readonly errorInPixels: number;
}

/** Cameras and the instances of a geometry that they may see. */
export interface GeometryView {
  /** Empty where no camera is known. */
  readonly views: readonly SceneView[];
  readonly instances: Iterable<{ readonly sceneFromShape: Matrix }>;
  /** A point in the scene's coordinates around which levels are refined first, whatever their size in the views. */
  readonly focus?: Point | undefined;
}
