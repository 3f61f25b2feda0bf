// A shape on the screen: a group with the draws of each patch's newest stage.

import { Group } from "three";
import type { Stage } from "../decode/stage.ts";
import type { GeometryDescription, MaterialDescription, ShapeDescription } from "../document/description.ts";
import type { SceneUniforms } from "./materials.ts";
import type { PatchDraws } from "./patchDraws.ts";
import { drawStage } from "./patchDraws.ts";
import type { TexturePool } from "./textures.ts";

export class ShapeObject {
  readonly group = new Group();
  readonly #textures: TexturePool;
  readonly #shared: SceneUniforms;
  readonly #patches = new Map<number, PatchDraws>();
  #material: MaterialDescription;

  constructor(textures: TexturePool, shared: SceneUniforms, shape: ShapeDescription) {
    this.#textures = textures;
    this.#shared = shared;
    this.#material = shape.material;
    this.group.matrixAutoUpdate = false;
  }

  setMaterial(material: MaterialDescription): void {
    this.#material = material;
    for (const draws of this.#patches.values()) draws.applyMaterial(material);
  }

  /** The new stage takes the old one's place as a whole; textures that both use stay where they are. */
  setStage(geometry: GeometryDescription, place: number, stage: Stage): void {
    const patch = geometry.patches[place];
    if (patch === undefined) throw new RangeError(`no patch ${place}`);
    const before = this.#patches.get(place);
    const draws = drawStage(stage, {
      textures: this.#textures, shared: this.#shared, geometry, patch, material: this.#material,
    });
    this.#patches.set(place, draws);
    this.group.add(...draws.objects);
    before?.dispose();
  }

  clear(): void {
    for (const draws of this.#patches.values()) draws.dispose();
    this.#patches.clear();
  }

  dispose(): void {
    this.clear();
    this.group.removeFromParent();
  }
}
