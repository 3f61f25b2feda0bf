// What is around somebody who walks, as two small pictures of depth tell it: one
// from his eye straight down shows the floor and everything lower than the eye,
// one around at the eye's level shows what is higher. A lintel above the eye is
// in neither, so doorways stay open.

import type { Quaternion, Vector3 } from "three";

/** Where to look: a level frame with y up, x and z level, and the eye at its origin. */
export interface DepthCamera {
  readonly eye: Vector3;
  /** From the frame to the scene. */
  readonly orientation: Quaternion;
  /** How far around, a length in the scene. */
  readonly reach: number;
}

/** In the frame of the lookout. */
export interface GroundSamples {
  /** Of what lies below the eye, above it 0; -Infinity where nothing does. */
  readonly floor: HeightMap;
  /** Places (x, z), one after the other, where something crosses the eye's level. */
  readonly walls: Float32Array;
}

/** Heights in the middles of square cells over -reach … reach along x and, row by row, along z. */
export interface HeightMap {
  readonly cells: number;
  readonly heights: Float32Array;
}

/** From the scene to the frame of a lookout. */
export function cameraFromScene({ eye, orientation }: DepthCamera, point: Vector3): Vector3 {
  return point.clone().sub(eye).applyQuaternion(orientation.clone().invert());
}

export function sceneFromCamera({ eye, orientation }: DepthCamera, point: Vector3): Vector3 {
  return point.clone().applyQuaternion(orientation).add(eye);
}
