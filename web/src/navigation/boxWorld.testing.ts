// A scene of boxes with depth images of it, for tests without a GPU.

import { Vector3 } from "three";
import type { DepthCamera, GroundSamples } from "./groundSamples.ts";
import { sceneFromCamera, cameraFromScene } from "./groundSamples.ts";

export interface WorldBox {
  readonly min: readonly [number, number, number];
  readonly max: readonly [number, number, number];
}

const cellsPerSide = 48;
const rayCount = 512;

/** The samples that a depth camera with y up takes. */
export function sampleGround(camera: DepthCamera, boxes: readonly WorldBox[]): GroundSamples {
  const { eye, range } = camera;
  const heights = Float32Array.from({ length: cellsPerSide * cellsPerSide }, (_, cell) => {
    const coordinateOf = (index: number) => ((2 * index + 1) / cellsPerSide - 1) * range;
    const { x, z } = sceneFromCamera(
      camera,
      new Vector3(coordinateOf(cell % cellsPerSide), 0, coordinateOf(Math.floor(cell / cellsPerSide))),
    );
    return highestBelow(boxes, x, eye.y, z) - eye.y;
  });
  const walls: number[] = [];
  for (let ray = 0; ray < rayCount; ++ray) {
    const angle = (2 * Math.PI * (ray + 0.5)) / rayCount;
    const direction = sceneFromCamera(
      { ...camera, eye: new Vector3() },
      new Vector3(Math.sin(angle), 0, Math.cos(angle)),
    );
    const distance = Math.min(...boxes.map((box) => distanceTo(box, eye, direction)));
    if (distance > 2 * range) continue;
    const point = cameraFromScene(camera, eye.clone().addScaledVector(direction, distance));
    walls.push(point.x, point.z);
  }
  return { floor: { cellsPerSide, heights }, walls: Float32Array.from(walls) };
}

/** The top of the highest box at (x, z) whose top is no higher than y. */
export function highestBelow(boxes: readonly WorldBox[], x: number, y: number, z: number): number {
  const below = boxes.filter(({ min, max }) => x >= min[0] && x <= max[0] && z >= min[2] && z <= max[2] && max[1] <= y);
  return Math.max(-Infinity, ...below.map(({ max }) => max[1]));
}

/** The distance along a horizontal ray to a box's nearest side; Infinity for a ray that misses it or starts inside. */
function distanceTo({ min, max }: WorldBox, from: Vector3, direction: Vector3): number {
  let [enter, leave] = [-Infinity, Infinity];
  for (const axis of [0, 1, 2]) {
    const [start, slope] = [from.getComponent(axis), direction.getComponent(axis)];
    const [a, b] = [((min[axis] ?? 0) - start) / slope, ((max[axis] ?? 0) - start) / slope];
    if (Math.abs(slope) < 1e-12) {
      if (start < (min[axis] ?? 0) || start > (max[axis] ?? 0)) return Infinity;
    } else {
      enter = Math.max(enter, Math.min(a, b));
      leave = Math.min(leave, Math.max(a, b));
    }
  }
  return enter >= 0 && enter <= leave ? enter : Infinity;
}
