// A shape on the screen: the draws of each patch's newest stage, hung into a
// group for each place where the shape stands in the scene.

import { Group } from "three";
import type { Stage } from "../decode/stage.ts";
import type { GeometryDescription, MaterialDescription, PatchDescription, ShapeDescription } from "../document/description.ts";
import type { PatchDraws, PatchSetting, PlacedDraw } from "./patchDraws.ts";
import { drawStage } from "./patchDraws.ts";
import { makeColorMapUniforms, setColorMap } from "./valueColors.ts";

/** What all shapes of a scene share. */
export type ShapeSetting = Pick<PatchSetting, "look" | "geometries" | "buffers" | "textures" | "shared">;

interface ShownPatch {
  readonly draws: PatchDraws;
  /** The draws in every place. */
  placed: PlacedDraw[];
}

export class ShapeObject {
  readonly #setting: ShapeSetting;
  readonly #groups: Group[] = [];
  readonly #patches = new Map<number, ShownPatch>();
  readonly #colorMap = makeColorMapUniforms();
  #material: MaterialDescription;
  #isPickable: boolean;

  constructor(setting: ShapeSetting, shape: ShapeDescription) {
    this.#setting = setting;
    this.#material = shape.material;
    this.#isPickable = shape.isPickable;
    setColorMap(this.#colorMap, shape.colorMap);
  }

  /** The group for the shape's place number `place`, 0, 1, 2 …, which its caller hangs into the scene. */
  groupAt(place: number): Group {
    const known = this.#groups[place];
    if (known !== undefined) return known;
    const group = new Group();
    group.matrixAutoUpdate = false;
    this.#groups[place] = group;
    for (const shown of this.#patches.values()) hang(shown, group);
    return group;
  }

  /** From now on the shape stands in so many places. */
  keepPlaces(count: number): void {
    for (const group of this.#groups.splice(count)) {
      group.removeFromParent();
      group.clear();
    }
    for (const shown of this.#patches.values()) shown.placed = shown.placed.filter(({ object }) => object.parent !== null);
  }

  get isEmpty(): boolean {
    return this.#patches.size === 0;
  }

  get isPickable(): boolean {
    return this.#isPickable;
  }

  /** Takes over what a changed document says, the geometry apart. */
  setShape({ material, isPickable, colorMap }: ShapeDescription): void {
    setColorMap(this.#colorMap, colorMap);
    this.#isPickable = isPickable;
    this.#material = material;
    for (const { draws } of this.#patches.values()) draws.applyMaterial(material);
  }

  /** The new stage takes the old one's place as a whole; textures that both use stay where they are. Undefined: nothing does. */
  setStage(geometry: GeometryDescription, place: number, stage: Stage | undefined): void {
    const patch = geometry.patches[place];
    if (patch === undefined) throw new RangeError(`no patch ${place}`);
    const before = this.#patches.get(place);
    this.#patches.delete(place);
    if (stage !== undefined) this.#show(geometry, patch, place, stage);
    if (before !== undefined) takeAway(before);
  }

  #show(geometry: GeometryDescription, patch: PatchDescription, place: number, stage: Stage): void {
    const shown = { draws: drawStage(stage, { ...this.#setting, geometry, patch, material: this.#material, colorMap: this.#colorMap }), placed: [] };
    for (const group of this.#groups) hang(shown, group);
    this.#patches.set(place, shown);
  }

  /** Every draw in every place, with the number of its patch. */
  *placedDraws(): Generator<PlacedDraw & { patch: number }> {
    for (const [patch, { placed }] of this.#patches) for (const draw of placed) yield { ...draw, patch };
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

function hang(shown: ShownPatch, group: Group): void {
  for (const placed of shown.draws.place()) {
    group.add(placed.object);
    shown.placed.push(placed);
  }
}

function takeAway({ draws, placed }: ShownPatch): void {
  for (const { object } of placed) object.removeFromParent();
  draws.dispose();
}
