// A shape on the screen: the draws of each patch's newest stage, hung into a
// group for each place where the shape stands in the scene.

import { Group } from "three";
import type { Bounds, Stage } from "../decode/stage.ts";
import type { AppearanceDescription, GeometryDescription, PatchDescription, ShapeDescription } from "../document/description.ts";
import type { ShownPicture } from "./look.ts";
import type { PatchDraws, PatchSetting, PlacedDraw } from "./patchDraws.ts";
import { drawStage } from "./patchDraws.ts";
import { makeColorMapUniforms, setColorMap } from "./valueColors.ts";

/** What all shapes of a scene share. */
export type ShapeSetting = Pick<PatchSetting, "look" | "geometries" | "buffers" | "textures" | "shared">;

/** In CSS pixels; GPUs draw none that are larger. */
const largestPoint = 1024;

interface ShownPatch {
  readonly stage: Stage;
  readonly draws: PatchDraws;
  /** The draws in every place. */
  placed: PlacedDraw[];
}

export class ShapeObject {
  readonly #setting: ShapeSetting;
  readonly #groups: Group[] = [];
  readonly #patches = new Map<number, ShownPatch>();
  readonly #colorMap = makeColorMapUniforms();
  #appearance: AppearanceDescription;
  #picture: ShownPicture | undefined;
  #isPickable: boolean;

  constructor(setting: ShapeSetting, shape: ShapeDescription) {
    this.#setting = setting;
    this.#appearance = shape.appearance;
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

  /** One for each place. */
  get groups(): readonly Group[] {
    return this.#groups;
  }

  /** Of patches of which the document does not tell any. */
  *bounds(): Generator<Bounds> {
    for (const { stage } of this.#patches.values()) if (stage.kind === "buffers" && stage.bounds) yield stage.bounds;
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
  setShape({ appearance, isPickable, colorMap }: ShapeDescription): void {
    setColorMap(this.#colorMap, colorMap);
    this.#isPickable = isPickable;
    this.#appearance = appearance;
    this.#applyAppearance();
  }

  /** What is laid over its surface, where it has texture coordinates; undefined: nothing. */
  setPicture(picture: ShownPicture | undefined): void {
    this.#picture = picture;
    this.#applyAppearance();
  }

  /** What its points may be wide, in CSS pixels. */
  get largestPoint(): number {
    const { points } = this.#appearance;
    if (points === undefined) return 0;
    const [a, b, c] = points.attenuation;
    return b === 0 && c === 0 ? Math.min(points.size / a, points.most) : Math.min(points.most, largestPoint);
  }

  #applyAppearance(): void {
    for (const { draws } of this.#patches.values()) draws.applyAppearance(this.#appearance, this.#picture);
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
    const draws = drawStage(stage, { ...this.#setting, geometry, patch, appearance: this.#appearance, colorMap: this.#colorMap, picture: this.#picture });
    const shown = { stage, draws, placed: [] };
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
