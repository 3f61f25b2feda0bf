// A shape on the screen: the draws of each patch's newest stage, hung into a
// group for each place where the shape stands in the scene.

import type { Object3D } from "three";
import { Group } from "three";
import type { Stage } from "../decode/stage.ts";
import type { GeometryDescription, MaterialDescription, ShapeDescription } from "../document/description.ts";
import type { PatchDraws, PatchSetting } from "./patchDraws.ts";
import { drawStage } from "./patchDraws.ts";

/** What all shapes of a scene share. */
export type ShapeSetting = Pick<PatchSetting, "geometries" | "textures" | "shared">;

interface ShownPatch {
  readonly draws: PatchDraws;
  /** The draws' objects in every place. */
  readonly objects: Object3D[];
}

export class ShapeObject {
  readonly #setting: ShapeSetting;
  readonly #groups: Group[] = [];
  readonly #patches = new Map<number, ShownPatch>();
  #material: MaterialDescription;

  constructor(setting: ShapeSetting, shape: ShapeDescription) {
    this.#setting = setting;
    this.#material = shape.material;
  }

  /** The group for the shape's place number `place`, 0, 1, 2 …, which its caller hangs into the scene. */
  groupAt(place: number): Group {
    const known = this.#groups[place];
    if (known !== undefined) return known;
    const group = new Group();
    group.matrixAutoUpdate = false;
    this.#groups[place] = group;
    for (const { draws, objects } of this.#patches.values()) hang(draws.makeObjects(), group, objects);
    return group;
  }

  /** From now on the shape stands in so many places. */
  keepPlaces(count: number): void {
    for (const group of this.#groups.splice(count)) {
      group.removeFromParent();
      group.clear();
    }
  }

  setMaterial(material: MaterialDescription): void {
    this.#material = material;
    for (const { draws } of this.#patches.values()) draws.applyMaterial(material);
  }

  /** The new stage takes the old one's place as a whole; textures that both use stay where they are. */
  setStage(geometry: GeometryDescription, place: number, stage: Stage): void {
    const patch = geometry.patches[place];
    if (patch === undefined) throw new RangeError(`no patch ${place}`);
    const before = this.#patches.get(place);
    const shown = { draws: drawStage(stage, { ...this.#setting, geometry, patch, material: this.#material }), objects: [] };
    for (const group of this.#groups) hang(shown.draws.makeObjects(), group, shown.objects);
    this.#patches.set(place, shown);
    if (before !== undefined) takeAway(before);
  }

  clear(): void {
    for (const shown of this.#patches.values()) takeAway(shown);
    this.#patches.clear();
  }

  dispose(): void {
    this.clear();
    this.keepPlaces(0);
  }
}

function hang(objects: Object3D[], group: Group, all: Object3D[]): void {
  group.add(...objects);
  all.push(...objects);
}

function takeAway({ draws, objects }: ShownPatch): void {
  for (const object of objects) object.removeFromParent();
  draws.dispose();
}
