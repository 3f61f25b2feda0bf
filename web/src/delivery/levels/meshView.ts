// How cameras see a mesh with levels of detail: the errors of its groups on the screen, and which groups the cameras
// will need if they go on as they move.

import type { GeometryDescription } from "../../document/description.ts";
import type { CutMesh } from "../../levels/cut.ts";
import { chooseCut, groupMemory, tolerance } from "../../levels/cut.ts";
import type { LevelIndex } from "../../levels/levelIndex.ts";
import { levelViewsOf, sceneFromLatticesOf } from "../../levels/levelViews.ts";
import type { ErrorInPixels } from "../../levels/projectedError.ts";
import { errorAround, errorInPixels } from "../../levels/projectedError.ts";
import type { GeometryView } from "../geometryView.ts";
import { CameraMotion } from "./cameraMotion.ts";
import type { SharedMeshCut } from "./sharedCut.ts";

/** Where a moving camera will be in this time, in milliseconds, groups are requested before it is there. */
const timeAhead = 500;
/** The part of a mesh's memory that these groups take at most, and their part of the priority of others. */
export const shareAhead = 1 / 4;

export class MeshView {
  readonly #geometry: GeometryDescription;
  readonly #motion = new CameraMotion();
  #view: GeometryView = { views: [], instances: [] };

  constructor(geometry: GeometryDescription) {
    this.#geometry = geometry;
  }

  /** The mesh is seen like this at a time in milliseconds. */
  follow(view: GeometryView, time: number): void {
    this.#view = { ...view, instances: Array.from(view.instances) };
    this.#motion.follow(view.views, time);
  }

  /** The errors in the views, which the focus does not change. */
  errorsInPixels(index: LevelIndex): ErrorInPixels {
    return errorInPixels(index, levelViewsOf(this.#geometry, this.#view));
  }

  /** The errors by which groups are chosen. */
  errorsAroundFocus(index: LevelIndex): ErrorInPixels {
    const errors = this.errorsInPixels(index);
    const { focus, instances } = this.#view;
    return focus ? errorAround(errors, index, sceneFromLatticesOf(this.#geometry, instances), focus) : errors;
  }

  /**
   * What the cut of the views ahead has beyond that of the mesh, by its errors, as far as memory is left for it. With
   * the target of `cut` it is a legal set.
   */
  groupsAhead(mesh: Omit<CutMesh, "errorInPixels">, cut: SharedMeshCut): ReadonlySet<number> {
    const views = this.#motion.viewsAhead(timeAhead);
    const ahead = new Set<number>();
    if (views.length === 0) return ahead;
    const errors = errorInPixels(mesh.index, levelViewsOf(this.#geometry, { ...this.#view, views }));
    const chosen = chooseCut([{ ...mesh, errorInPixels: errors }], { tolerance, budget: cut.maxBytes }).meshes[0];
    let left = Math.min(shareAhead * cut.maxBytes, cut.maxBytes - cut.bytes);
    for (const group of chosen?.target ?? []) {
      if (cut.target.has(group)) continue;
      left -= groupMemory(mesh, group);
      if (left < 0) break;
      ahead.add(group);
    }
    return ahead;
  }
}
