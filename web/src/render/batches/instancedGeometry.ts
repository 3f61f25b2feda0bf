// A draw's geometry in many places: instances know by an attribute which place is
// theirs. What consists of instances already, as wide lines do, has all of them in
// one place, then all in the next.

import type { BufferGeometry } from "three";
import { InstancedBufferAttribute, InstancedBufferGeometry, Sphere } from "three";
import { repeatedLines } from "../lines/wideLineGeometry.ts";

/** Wide lines in buffers are stored again for each place of a draw, as no attribute begins anew; so many of them in a draw. */
export const maxRepeatedLines = 65536;

/** In which one draw can show the geometry. */
export function maxInstancesOf(shape: BufferGeometry): number {
  if (!areStoredLines(shape)) return Infinity;
  return Math.max(1, Math.floor(maxRepeatedLines / shape.instanceCount));
}

export class InstancedGeometry {
  readonly geometry: InstancedBufferGeometry;
  /** In how many places it can be. */
  readonly capacity: number;
  readonly #shape: BufferGeometry;
  readonly #places: InstancedBufferAttribute;
  readonly #instancesPerPlace: number;

  constructor(shape: BufferGeometry, capacity: number) {
    this.capacity = capacity;
    this.#shape = shape;
    this.#instancesPerPlace = shape instanceof InstancedBufferGeometry ? shape.instanceCount : 1;
    this.geometry = shape instanceof InstancedBufferGeometry ? repeatedLines(shape, capacity) : sharing(shape);
    this.geometry.boundingSphere = new Sphere(); // three.js would make one of the stored numbers
    // Of no place: the first frame writes them all.
    this.#places = new InstancedBufferAttribute(
      new Uint32Array(capacity).fill(2 ** 32 - 1),
      1,
      false,
      this.#instancesPerPlace,
    );
    this.geometry.setAttribute("instanceIndex", this.#places);
  }

  /** From now on it is in these places, at most as many as its capacity. */
  setInstances(places: readonly number[]): void {
    this.geometry.instanceCount = places.length * this.#instancesPerPlace;
    const numbers = this.#places.array;
    if (places.every((place, n) => numbers[n] === place)) return;
    numbers.set(places);
    this.#places.clearUpdateRanges();
    this.#places.addUpdateRange(0, places.length);
    this.#places.needsUpdate = true;
  }

  /** The buffers that it shares stay. */
  dispose(): void {
    if (this.geometry.index === this.#shape.index) this.geometry.setIndex(null);
    for (const [name, attribute] of Object.entries(this.#shape.attributes)) {
      if (this.geometry.getAttribute(name) === attribute) this.geometry.deleteAttribute(name);
    }
    this.geometry.dispose();
  }
}

function areStoredLines(shape: BufferGeometry): shape is InstancedBufferGeometry {
  return shape instanceof InstancedBufferGeometry && Object.keys(shape.attributes).length > 0;
}

function sharing(shape: BufferGeometry): InstancedBufferGeometry {
  const geometry = new InstancedBufferGeometry();
  for (const [name, attribute] of Object.entries(shape.attributes)) geometry.setAttribute(name, attribute);
  geometry.setIndex(shape.index);
  geometry.setDrawRange(shape.drawRange.start, shape.drawRange.count);
  return geometry;
}
