// The visible instances of each geometry and of each texture in a scene, updated with
// the scene's changes.

import type { GeometryInstance } from "../delivery/filePriority.ts";
import { geometryInstance } from "../delivery/filePriority.ts";
import { textureKeyOf } from "../delivery/textureDeliveries.ts";
import type { GeometryDescription } from "../document/description.ts";
import type { ShapeInstance } from "../scene/instances.ts";

/** Keyed by the instance of the shape's node. */
type Instances = Map<object, GeometryInstance>;

const noInstances: Instances = new Map();

export class VisibleInstances {
  readonly #geometries = new Map<GeometryDescription, Instances>();
  /** By texture key (textureKeyOf). */
  readonly #textures = new Map<string, Instances>();
  readonly #visible = new Map<object, ShapeInstance>();

  /** Updates instances that have been added, changed or removed (undefined). */
  follow(instances: Iterable<readonly [node: object, instance: ShapeInstance | undefined]>): void {
    for (const [node, instance] of instances) {
      const before = this.#visible.get(node);
      if (before !== undefined) this.#remove(node, before);
      if (instance?.shape.visible === true) this.#add(node, instance);
    }
  }

  ofGeometry(geometry: GeometryDescription): Iterable<GeometryInstance> {
    return (this.#geometries.get(geometry) ?? noInstances).values();
  }

  ofTexture(key: string): Iterable<GeometryInstance> {
    return (this.#textures.get(key) ?? noInstances).values();
  }

  #add(node: object, instance: ShapeInstance): void {
    const {
      shape: {
        geometry,
        priority,
        appearance: { textures, cubeMap },
      },
      sceneFromShape,
    } = instance;
    if (geometry === undefined) return;
    const added = geometryInstance(geometry, sceneFromShape.elements, priority, textures.length > 0);
    add(this.#geometries, geometry, node, added);
    for (const texture of [...textures, ...(cubeMap?.pictures ?? [])])
      add(this.#textures, textureKeyOf(texture), node, added);
    this.#visible.set(node, instance);
  }

  #remove(
    node: object,
    {
      shape: {
        geometry,
        appearance: { textures, cubeMap },
      },
    }: ShapeInstance,
  ): void {
    this.#visible.delete(node);
    if (geometry) remove(this.#geometries, geometry, node);
    for (const texture of [...textures, ...(cubeMap?.pictures ?? [])])
      remove(this.#textures, textureKeyOf(texture), node);
  }
}

function add<Key>(all: Map<Key, Instances>, key: Key, node: object, instance: GeometryInstance): void {
  const instances = all.get(key);
  if (instances === undefined) all.set(key, new Map([[node, instance]]));
  else instances.set(node, instance);
}

function remove<Key>(all: Map<Key, Instances>, key: Key, node: object): void {
  const instances = all.get(key);
  instances?.delete(node);
  if (instances?.size === 0) all.delete(key);
}
