// A LOD node as a three.js LOD: a renderer that draws it updates its level for its own
// camera in the same frame. three.js measures distances from the object's origin in
// world units; X3D measures them from `center` in the LOD's own units.

import type { Camera, Intersection, Object3D, Raycaster } from "three";
import { LOD, Matrix4, Vector3 } from "three";
import type { LodDescription } from "../document/description.ts";
import { lodLevelAt } from "../scene/lodLevel.ts";

/**
 * The state of an object's shapes. `loading`: some are still being loaded; `displayed`: all have loaded or failed, and
 * at least one displays something; `failed`: none displays anything, because files have failed; `empty`: there are
 * none. The state of a group is the first of these that any of its children has.
 */
export const loadStates = ["loading", "displayed", "failed", "empty"] as const;
export type LoadState = (typeof loadStates)[number];

/** Knows how far the levels of a LOD have loaded, and requests the level that cameras need. */
export interface SceneLodOwner {
  loadStateOf(level: Object3D): LoadState;
  /** A camera has updated a LOD: `takeDistance` gives its distance. */
  onCameraUpdate(): void;
}

// Reused: a scene may have thousands of LODs, which are updated in every frame.
const eye = new Vector3(),
  center = new Vector3();
const lodFromWorld = new Matrix4();

export class SceneLod extends LOD {
  readonly description: LodDescription;
  readonly #owner: SceneLodOwner;
  /** The level for the last camera; before the first, the last level, which needs the fewest files. */
  #level: number;
  #displayedLevel: number | undefined;
  readonly #readyLevels = new Set<number>();
  #minDistance = Infinity;

  constructor(description: LodDescription, owner: SceneLodOwner) {
    super();
    this.description = description;
    this.#owner = owner;
    this.#level = description.levelCount - 1;
  }

  /** Makes the children the levels, in their order. Call it after children have been added. */
  fill(): void {
    const { range } = this.description;
    this.levels.splice(
      0,
      Infinity,
      ...this.children.map((object, index) => ({
        object,
        distance: index === 0 ? 0 : (range[index - 1] ?? Infinity),
        hysteresis: 0,
      })),
    );
    this.#updateVisibility();
  }

  /** The distance of the nearest camera since the last call, in the LOD's own units; Infinity where there was none. */
  takeDistance(): number {
    const distance = this.#minDistance;
    this.#minDistance = Infinity;
    return distance;
  }

  /** Index of the displayed level. */
  override getCurrentLevel(): number {
    return this.#displayedLevel ?? this.#level;
  }

  /** Called by the renderer before it draws, unless `autoUpdate` is false. */
  override update(camera: Camera): void {
    const { range, levelCount } = this.description;
    const distance = this.#distanceFrom(camera);
    this.#minDistance = Math.min(this.#minDistance, distance);
    this.#level = lodLevelAt(distance, range, levelCount, this.#level);
    this.#updateVisibility();
    this.#owner.onCameraUpdate();
  }

  /** Intersects the displayed level only. */
  override raycast(raycaster: Raycaster, intersects: Intersection[]): boolean {
    const level = this.levels[this.getCurrentLevel()]?.object;
    if (level !== undefined) raycaster.intersectObject(level, true, intersects);
    return false; // three.js does not continue with the children
  }

  #updateVisibility(): void {
    this.#displayedLevel = this.#isReady(this.#level) ? this.#level : (this.#substituteLevel() ?? this.#level);
    this.levels.forEach(({ object }, index) => {
      object.visible = index === this.#displayedLevel;
    });
  }

  #isReady(index: number): boolean {
    const level = this.levels[index];
    if (level === undefined || this.#readyLevels.has(index)) return true;
    const state = this.#owner.loadStateOf(level.object);
    const isReady = state === "displayed" || state === "empty";
    if (isReady) this.#readyLevels.add(index); // for good: a level that has been displayed stays displayed
    return isReady;
  }

  /** The level to display until the required one is ready: the one displayed now, or else the nearest loaded one. */
  #substituteLevel(): number | undefined {
    const { levels } = this;
    const rank = (index: number) => (index === this.#displayedLevel ? -1 : Math.abs(index - this.#level));
    const others = Array.from(levels.keys()).filter((index) => {
      const level = levels[index];
      return level !== undefined && index !== this.#level && this.#owner.loadStateOf(level.object) === "displayed";
    });
    return others.sort((a, b) => rank(a) - rank(b))[0];
  }

  /** Infinity where the LOD is scaled to nothing. */
  #distanceFrom(camera: Camera): number {
    if (this.matrixWorld.determinant() === 0) return Infinity;
    eye.setFromMatrixPosition(camera.matrixWorld).applyMatrix4(lodFromWorld.copy(this.matrixWorld).invert());
    return eye.distanceTo(center.set(...this.description.center));
  }
}
