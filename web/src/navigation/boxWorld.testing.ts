// A world of boxes, looked at as the GPU looks at a scene.

import { Vector3 } from "three";
import type { DepthCamera, GroundSamples } from "./groundSamples.ts";
import { sceneFromCamera, cameraFromScene } from "./groundSamples.ts";

export interface WorldBox {
  readonly min: readonly [number, number, number];
  readonly max: readonly [number, number, number];
}

const cells = 48;
const rays = 512;

/** With y up. */
export function lookAround(lookout: DepthCamera, boxes: readonly WorldBox[]): GroundSamples {
  const { eye, reach } = lookout;
  const heights = Float32Array.from({ length: cells * cells }, (_, cell) => {
    const line = (at: number) => ((2 * at + 1) / cells - 1) * reach;
    const { x, z } = sceneFromCamera(lookout, new Vector3(line(cell % cells), 0, line(Math.floor(cell / cells))));
    return highestBelow(boxes, x, eye.y, z) - eye.y;
  });
  const walls: number[] = [];
  for (let ray = 0; ray < rays; ++ray) {
    const angle = (2 * Math.PI * (ray + 0.5)) / rays;
    const way = sceneFromCamera({ ...lookout, eye: new Vector3() }, new Vector3(Math.sin(angle), 0, Math.cos(angle)));
    const distance = Math.min(...boxes.map((box) => distanceTo(box, eye, way)));
    if (distance > 2 * reach) continue;
    const place = cameraFromScene(lookout, eye.clone().addScaledVector(way, distance));
    walls.push(place.x, place.z);
  }
  return { floor: { cells, heights }, walls: Float32Array.from(walls) };
}

/** The top of the highest box there that is no higher than y. */
export function highestBelow(boxes: readonly WorldBox[], x: number, y: number, z: number): number {
  const under = boxes.filter(({ min, max }) => x >= min[0] && x <= max[0] && z >= min[2] && z <= max[2] && max[1] <= y);
  return Math.max(-Infinity, ...under.map(({ max }) => max[1]));
}

/** Along a level ray to the first of its sides; those seen from within do not count. */
function distanceTo({ min, max }: WorldBox, from: Vector3, way: Vector3): number {
  let [enter, leave] = [-Infinity, Infinity];
  for (const axis of [0, 1, 2]) {
    const [start, slope] = [from.getComponent(axis), way.getComponent(axis)];
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
