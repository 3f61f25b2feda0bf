// Where the camera is, between those who move it and those who draw.

import type { Pose } from "../navigation/cameraPose.ts";
import type { DepthCamera, GroundSamples } from "../navigation/groundSamples.ts";

/** Where the camera is and what it sees, as plain numbers. */
export interface View {
  readonly position: readonly [number, number, number];
  /** 16 numbers, column by column. */
  readonly clipFromScene: readonly number[];
  /** Device pixels that something of length 1 covers at a distance of 1, in the middle of the view. */
  readonly pixelsPerUnit: number;
  readonly near: number;
}

/** Where the camera is. */
export interface CameraController {
  readonly pose: Pose;
  /** What is nearer need not be seen. */
  readonly clearance: number;
  /** At this moment, in milliseconds as of `performance.now()`. */
  advance(nowMs: number): Pose;
  /** Another frame is due after this one. */
  readonly isMoving: boolean;
  /** From where he wants to know what is around. */
  readonly depthCamera: DepthCamera | undefined;
  addGroundSamples(camera: DepthCamera, samples: GroundSamples): void;
}
