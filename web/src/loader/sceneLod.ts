// A LOD of the document as a LOD of three.js: whoever draws it shows the level for
// his camera, in the same frame. Where three measures from the object's middle in
// the world's lengths, X3D measures from `center` in the LOD's own.

import type { Camera, Intersection, Object3D, Raycaster } from "three";
import { LOD, Matrix4, Vector3 } from "three";
import type { LodDescription } from "../document/description.ts";
import { lodLevelAt } from "../scene/lodLevel.ts";

/**
 * How much of something is there: it is still coming; all of it shows something, as far
 * as it ever will; nothing of it has come, or will; or there is nothing in it to see.
 * The first of these that holds for a part holds for the whole.
 */
export const loadStates = ["loading", "displayed", "failed", "empty"] as const;
export type LoadState = (typeof loadStates)[number];

/** Who brings what levels show. */
export interface SceneLodOwner {
  loadStateOf(level: Object3D): LoadState;
  /** A camera has looked at it: `takeDistance` says from where. */
  onCamera(): void;
}

// Of a scene of thousands, each is asked in each frame.
const eye = new Vector3(),
  center = new Vector3();
const levelsFromWorld = new Matrix4();

export class SceneLod extends LOD {
  readonly description: LodDescription;
  readonly #keeper: SceneLodOwner;
  /** What the last camera is to see. Before any has looked, what asks for least. */
  #wanted: number;
  #shown: number | undefined;
  readonly #ready = new Set<number>();
  #nearest = Infinity;

  constructor(description: LodDescription, keeper: SceneLodOwner) {
    super();
    this.description = description;
    this.#keeper = keeper;
    this.#wanted = description.levelCount - 1;
  }

  /** Its children have come: they are its levels, in their order. */
  fill(): void {
    const { range } = this.description;
    this.levels.splice(
      0,
      Infinity,
      ...this.children.map((object, place) => ({
        object,
        distance: place === 0 ? 0 : (range[place - 1] ?? Infinity),
        hysteresis: 0,
      })),
    );
    this.#show();
  }

  /** The least distance from which it has been looked at since this was last called, in its own lengths; Infinity: it has not. */
  takeDistance(): number {
    const distance = this.#nearest;
    this.#nearest = Infinity;
    return distance;
  }

  /** Of those that there are, the level that is seen. */
  override getCurrentLevel(): number {
    return this.#shown ?? this.#wanted;
  }

  /** As the renderer calls it before it draws, unless `autoUpdate` is false. */
  override update(camera: Camera): void {
    const { range, levelCount: count } = this.description;
    const distance = this.#distanceFrom(camera);
    this.#nearest = Math.min(this.#nearest, distance);
    this.#wanted = lodLevelAt(distance, range, count, this.#wanted);
    this.#show();
    this.#keeper.onCamera();
  }

  /** Rays meet what is seen. */
  override raycast(raycaster: Raycaster, intersects: Intersection[]): boolean {
    const level = this.levels[this.getCurrentLevel()]?.object;
    if (level !== undefined) raycaster.intersectObject(level, true, intersects);
    return false; // the others are not met
  }

  #show(): void {
    this.#shown = this.#isReady(this.#wanted) ? this.#wanted : (this.#standIn() ?? this.#wanted);
    this.levels.forEach(({ object }, place) => {
      object.visible = place === this.#shown;
    });
  }

  #isReady(place: number): boolean {
    const level = this.levels[place];
    if (level === undefined || this.#ready.has(place)) return true;
    const presence = this.#keeper.loadStateOf(level.object);
    const isReady = presence === "displayed" || presence === "empty";
    if (isReady) this.#ready.add(place); // and is from then on
    return isReady;
  }

  /** Until what is wanted has come: what stands there already, or else is nearest to it. */
  #standIn(): number | undefined {
    const { levels } = this;
    const rank = (place: number) => (place === this.#shown ? -1 : Math.abs(place - this.#wanted));
    const others = Array.from(levels.keys()).filter((place) => {
      const level = levels[place];
      return level !== undefined && place !== this.#wanted && this.#keeper.loadStateOf(level.object) === "displayed";
    });
    return others.sort((a, b) => rank(a) - rank(b))[0];
  }

  /** Infinite in one without extent. */
  #distanceFrom(camera: Camera): number {
    if (this.matrixWorld.determinant() === 0) return Infinity;
    eye.setFromMatrixPosition(camera.matrixWorld).applyMatrix4(levelsFromWorld.copy(this.matrixWorld).invert());
    return eye.distanceTo(center.set(...this.description.center));
  }
}
