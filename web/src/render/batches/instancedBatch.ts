// A draw in many places at once: an instance for each that the camera sees.

import type { BufferGeometry, Frustum, Material } from "three";
import { InstancedBufferAttribute, InstancedBufferGeometry, Sphere } from "three";
import type { DrawnObject } from "../drawnObject.ts";
import { objectOf } from "../drawnObject.ts";
import type { GeometryPool } from "../stageGeometries.ts";
import type { Batch, BatchedDraw, Member } from "./batch.ts";

const leastInstances = 16;

export class InstancedBatch implements Batch {
  readonly object: DrawnObject;
  readonly #draw: BatchedDraw;
  readonly #geometries: GeometryPool;
  readonly #shape: BufferGeometry;
  readonly #material: Material;
  readonly #members = new Set<Member>();
  #geometry: InstancedBufferGeometry;
  #places: InstancedBufferAttribute;

  constructor(draw: BatchedDraw, material: Material, geometries: GeometryPool) {
    const [range] = draw.ranges;
    const shape = range && geometries.acquire(draw.stage)[draw.stage.draws.indexOf(range)];
    if (range === undefined || shape === undefined) throw new RangeError("the draw is not one of its stage");
    this.#draw = draw;
    this.#geometries = geometries;
    this.#shape = shape;
    this.#material = material;
    [this.#geometry, this.#places] = instancedOf(shape, leastInstances);
    this.object = objectOf(range, this.#geometry, material);
  }

  get isEmpty(): boolean {
    return this.#members.size === 0;
  }

  hasRoomFor(): boolean {
    return true;
  }

  add(member: Member): void {
    this.#members.add(member);
    if (this.#members.size <= this.#places.count) return;
    this.#freeGeometry();
    [this.#geometry, this.#places] = instancedOf(this.#shape, 2 * this.#places.count);
    this.object.geometry = this.#geometry;
  }

  remove(member: Member): void {
    this.#members.delete(member);
  }

  touch(): void {
    // Every frame looks at all of them.
  }

  update(frustum: Frustum): void {
    const numbers = this.#places.array;
    let count = 0;
    let isOther = false;
    for (const { place, isShown, sphere } of this.#members) {
      if (!isShown || !frustum.intersectsSphere(sphere)) continue;
      isOther ||= numbers[count] !== place;
      numbers[count] = place;
      count += 1;
    }
    this.#geometry.instanceCount = count;
    this.object.visible = count > 0;
    if (!isOther) return;
    this.#places.clearUpdateRanges();
    this.#places.addUpdateRange(0, count);
    this.#places.needsUpdate = true;
  }

  dispose(): void {
    this.object.removeFromParent();
    this.#freeGeometry();
    this.#material.dispose();
    this.#geometries.release(this.#draw.stage);
  }

  /** The stage's buffers stay, that of the places goes. */
  #freeGeometry(): void {
    this.#geometry.setIndex(null);
    for (const name of Object.keys(this.#geometry.attributes)) if (name !== "place") this.#geometry.deleteAttribute(name);
    this.#geometry.dispose();
  }
}

function instancedOf(shape: BufferGeometry, capacity: number): [InstancedBufferGeometry, InstancedBufferAttribute] {
  const geometry = new InstancedBufferGeometry();
  for (const [name, attribute] of Object.entries(shape.attributes)) geometry.setAttribute(name, attribute);
  geometry.setIndex(shape.index);
  geometry.setDrawRange(shape.drawRange.start, shape.drawRange.count);
  geometry.boundingSphere = new Sphere(); // three.js would make one of the stored numbers
  // Of no place: the first frame writes them all.
  const places = new InstancedBufferAttribute(new Uint32Array(capacity).fill(2 ** 32 - 1), 1);
  geometry.setAttribute("place", places);
  return [geometry, places];
}
