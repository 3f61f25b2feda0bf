// Interfaces between the camera controller and the renderer.

import type { Pose } from "../navigation/cameraPose.ts";
import type { DepthCamera, GroundSamples } from "../navigation/groundSamples.ts";

/** The camera's position and projection, as plain numbers. */
export interface View {
  readonly position: readonly [number, number, number];
  /** A column-major 4 x 4 matrix. */
  readonly clipFromScene: readonly number[];
  /** Device pixels that a length of 1 covers at distance 1, in the middle of the view. */
  readonly pixelsPerUnit: number;
  /** Distance of the near plane. */
  readonly near: number;
}

/** Controls the camera. */
export interface CameraController {
  readonly pose: Pose;
  /** Objects nearer to the camera than this distance need not be drawn. */
  readonly clearance: number;
  /** The pose at a time in milliseconds, as of `performance.now()`. */
  advance(nowMs: number): Pose;
  /** Whether another frame is needed after this one. */
  readonly isMoving: boolean;
  /** The camera of the depth images that the controller needs; undefined if it needs none. */
  readonly depthCamera: DepthCamera | undefined;
  addGroundSamples(camera: DepthCamera, samples: GroundSamples): void;
  /** The pose of the last frame, if the controller needs to know the surface at its center. */
  readonly surfaceSearch: Pose | undefined;
  /** The distance from a pose to the surface at its center, Infinity where there is none. */
  addSurfaceAhead(pose: Pose, distance: number): void;
}
