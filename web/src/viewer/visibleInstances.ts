// Where geometries and pictures are seen in a scene, kept true to what changes in it.

import type { GeometryInstance } from "../delivery/filePriority.ts";
import { geometryInstance } from "../delivery/filePriority.ts";
import { pictureKeyOf } from "../delivery/textureDeliveries.ts";
import type { GeometryDescription } from "../document/description.ts";
import type { ShapeInstance } from "../scene/instances.ts";
import type { SceneChanges } from "../render/shapes/shapeChanges.ts";

/** By the places where they are. */
type Seen = Map<object, GeometryInstance>;

const nowhere: Seen = new Map();

export class VisibleInstances {
  readonly #geometries = new Map<GeometryDescription, Seen>();
  /** By their keys. */
  readonly #pictures = new Map<string, Seen>();
  readonly #shown = new Map<object, ShapeInstance>();

  follow(places: SceneChanges["instances"]): void {
    for (const [place, placed] of places) {
      const before = this.#shown.get(place);
      if (before !== undefined) this.#forget(place, before);
      if (placed?.shape.visible === true) this.#note(place, placed);
    }
  }

  ofGeometry(geometry: GeometryDescription): Iterable<GeometryInstance> {
    return (this.#geometries.get(geometry) ?? nowhere).values();
  }

  ofPicture(key: string): Iterable<GeometryInstance> {
    return (this.#pictures.get(key) ?? nowhere).values();
  }

  #note(place: object, placed: ShapeInstance): void {
    const {
      shape: {
        geometry,
        priority,
        appearance: { textures },
      },
      sceneFromShape,
    } = placed;
    if (geometry === undefined) return;
    const seen = geometryInstance(geometry, sceneFromShape.elements, priority, textures.length > 0);
    add(this.#geometries, geometry, place, seen);
    for (const texture of textures) add(this.#pictures, pictureKeyOf(texture), place, seen);
    this.#shown.set(place, placed);
  }

  #forget(
    place: object,
    {
      shape: {
        geometry,
        appearance: { textures },
      },
    }: ShapeInstance,
  ): void {
    this.#shown.delete(place);
    if (geometry) remove(this.#geometries, geometry, place);
    for (const texture of textures) remove(this.#pictures, pictureKeyOf(texture), place);
  }
}

function add<Key>(all: Map<Key, Seen>, key: Key, place: object, placed: GeometryInstance): void {
  const seen = all.get(key);
  if (seen === undefined) all.set(key, new Map([[place, placed]]));
  else seen.set(place, placed);
}

function remove<Key>(all: Map<Key, Seen>, key: Key, place: object): void {
  const seen = all.get(key);
  seen?.delete(place);
  if (seen?.size === 0) all.delete(key);
}
