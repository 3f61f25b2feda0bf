// The surroundings of a walking avatar, sampled by two small depth images: one, from the eye straight down, shows
// surfaces below the eye; the other, around the eye at its level, shows walls. A lintel above the eye is in neither, so
// doorways stay open.

import type { Quaternion, Vector3 } from "three";

/** The frame of the depth images: y up, x and z horizontal, the eye at the origin. */
export interface DepthCamera {
  readonly eye: Vector3;
  /** Rotates from the frame to the scene. */
  readonly orientation: Quaternion;
  /** How far the images extend around the eye, in scene units. */
  readonly range: number;
}

/** In the frame of the depth camera. */
export interface GroundSamples {
  /** Heights of the surfaces below the eye, at most 0; -Infinity where there is none. */
  readonly floor: HeightMap;
  /** x and z of each point where a surface crosses the eye's level. */
  readonly walls: Float32Array;
}

/**
 * Heights at the centers of square cells over -range … range along x and, row by row, along z.
 */
export interface HeightMap {
  readonly cellsPerSide: number;
  readonly heights: Float32Array;
}

/** A point of the scene in the frame of a depth camera. */
export function cameraFromScene({ eye, orientation }: DepthCamera, point: Vector3): Vector3 {
  return point.clone().sub(eye).applyQuaternion(orientation.clone().invert());
}

/** A point of a depth camera's frame in the scene. */
export function sceneFromCamera({ eye, orientation }: DepthCamera, point: Vector3): Vector3 {
  return point.clone().applyQuaternion(orientation).add(eye);
}
