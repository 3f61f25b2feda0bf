// The geometry of an instanced draw: the attribute `instanceIndex` says which record each instance
// uses. Wide lines are instances themselves: all lines of the first shape instance come first, then
// all of the next.

import type { BufferGeometry } from "three";
import { InstancedBufferAttribute, InstancedBufferGeometry, Sphere } from "three";
import { repeatedLines } from "../lines/wideLineGeometry.ts";

/**
 * Wide lines in buffers are repeated for each shape instance, since instanced attributes cannot start over; this is
 * the maximum of lines per draw.
 */
export const maxRepeatedLines = 65536;

/** The maximum of shape instances in one draw of the geometry. */
export function maxInstancesOf(shape: BufferGeometry): number {
  if (!areStoredLines(shape)) return Infinity;
  return Math.max(1, Math.floor(maxRepeatedLines / shape.instanceCount));
}

export class InstancedGeometry {
  readonly geometry: InstancedBufferGeometry;
  /** The number of shape instances that it has room for. */
  readonly capacity: number;
  readonly #shape: BufferGeometry;
  readonly #instanceIndices: InstancedBufferAttribute;
  readonly #objectsPerInstance: number;

  constructor(shape: BufferGeometry, capacity: number) {
    this.capacity = capacity;
    this.#shape = shape;
    this.#objectsPerInstance = shape instanceof InstancedBufferGeometry ? shape.instanceCount : 1;
    this.geometry = shape instanceof InstancedBufferGeometry ? repeatedLines(shape, capacity) : sharing(shape);
    this.geometry.boundingSphere = new Sphere(); // otherwise three.js computes one from stored positions
    // No valid index, so that the first frame writes all.
    this.#instanceIndices = new InstancedBufferAttribute(
      new Uint32Array(capacity).fill(2 ** 32 - 1),
      1,
      false,
      this.#objectsPerInstance,
    );
    this.geometry.setAttribute("instanceIndex", this.#instanceIndices);
  }

  /** Sets the instances, at most `capacity`. */
  setInstances(instanceIndices: readonly number[]): void {
    this.geometry.instanceCount = instanceIndices.length * this.#objectsPerInstance;
    const numbers = this.#instanceIndices.array;
    if (instanceIndices.every((index, n) => numbers[n] === index)) return;
    numbers.set(instanceIndices);
    this.#instanceIndices.clearUpdateRanges();
    this.#instanceIndices.addUpdateRange(0, instanceIndices.length);
    this.#instanceIndices.needsUpdate = true;
  }

  /** Shared buffers stay. */
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
