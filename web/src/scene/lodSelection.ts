// Which level each LOD of a scene shows, by where the viewer is.

import type { Vector3 } from "three";
import { Matrix4 } from "three";
import type { SceneElement } from "../document/element.ts";
import { lodLevelAt } from "./lodLevel.ts";
import type { LodInstance } from "./instances.ts";

export class LodSelection {
  #chosen = new Map<SceneElement, number>();

  /** Undefined until the viewer has been near it. */
  levelOf(lod: SceneElement): number | undefined {
    return this.#chosen.get(lod);
  }

  /** One that stands in several places shows what the nearest of them needs. Those of which another level is to be seen than before. */
  update(placed: readonly LodInstance[], viewer: Vector3): readonly SceneElement[] {
    const nearest = new Map<SceneElement, { levels: LodInstance; distance: number }>();
    for (const levels of placed) {
      const distance = distanceFrom(levels, viewer);
      if (distance < (nearest.get(levels.element)?.distance ?? Infinity))
        nearest.set(levels.element, { levels, distance });
    }
    const changed: SceneElement[] = [];
    for (const [
      element,
      {
        levels: { range, levelCount: count },
        distance,
      },
    ] of nearest) {
      const before = this.#chosen.get(element);
      const level = lodLevelAt(distance, range, count, before);
      // Unknown ones show their last.
      if (level !== (before ?? count - 1)) changed.push(element);
      this.#chosen.set(element, level);
    }
    return changed;
  }
}

/** In the coordinates of the LOD, which `range` is in; infinite in one without extent. */
function distanceFrom({ sceneFromLod: sceneFromLevels, center: [x, y, z] }: LodInstance, viewer: Vector3): number {
  if (sceneFromLevels.determinant() === 0) return Infinity;
  const { x: ownX, y: ownY, z: ownZ } = viewer.clone().applyMatrix4(new Matrix4().copy(sceneFromLevels).invert());
  return Math.hypot(ownX - x, ownY - y, ownZ - z);
}
