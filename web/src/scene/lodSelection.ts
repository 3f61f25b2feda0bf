// Selects the level of each LOD in a scene by the viewer's distance.

import type { Vector3 } from "three";
import { Matrix4 } from "three";
import type { SceneElement } from "../document/element.ts";
import { lodLevelAt } from "./lodLevel.ts";
import type { LodInstance } from "./instances.ts";

export class LodSelection {
  #levels = new Map<SceneElement, number>();

  /** Undefined before the first update with this LOD. */
  levelOf(lod: SceneElement): number | undefined {
    return this.#levels.get(lod);
  }

  /**
   * Selects levels anew and returns the LODs whose level changes. A LOD with several instances displays the level that
   * the nearest one needs.
   */
  update(lods: readonly LodInstance[], viewer: Vector3): readonly SceneElement[] {
    const nearest = new Map<SceneElement, { lod: LodInstance; distance: number }>();
    for (const lod of lods) {
      const distance = distanceFrom(lod, viewer);
      if (distance < (nearest.get(lod.element)?.distance ?? Infinity)) nearest.set(lod.element, { lod, distance });
    }
    const changed: SceneElement[] = [];
    for (const [element, { lod, distance }] of nearest) {
      const { range, levelCount } = lod;
      const previous = this.#levels.get(element);
      const level = lodLevelAt(distance, range, levelCount, previous);
      // A LOD displays its last level until a level is selected.
      if (level !== (previous ?? levelCount - 1)) changed.push(element);
      this.#levels.set(element, level);
    }
    return changed;
  }
}

/** The distance in the LOD's own coordinates, which `range` is in; infinite under a singular transform. */
function distanceFrom({ sceneFromLod, center: [x, y, z] }: LodInstance, viewer: Vector3): number {
  if (sceneFromLod.determinant() === 0) return Infinity;
  const { x: ownX, y: ownY, z: ownZ } = viewer.clone().applyMatrix4(new Matrix4().copy(sceneFromLod).invert());
  return Math.hypot(ownX - x, ownY - y, ownZ - z);
}
