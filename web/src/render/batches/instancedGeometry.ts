// The geometry of an instanced draw. Its attribute `instanceIndex` holds the index of the record
// that each instance uses. Wide lines are instances themselves: all lines of the first shape
// instance come first, then all of the next.

import type { BufferGeometry } from "three";
import { InstancedBufferAttribute, InstancedBufferGeometry, Sphere } from "three";
import { lateWideLines } from "../lines/lateWideLines.ts";

/**
 * Wide lines in buffers are repeated for each shape instance, since instanced attributes cannot start over; this is
 * the maximum number of lines per draw.
 */
export const maxRepeatedLines = 65536;

/** The maximum number of shape instances in one draw of the geometry. */
export function maxInstancesOf(source: BufferGeometry): number {
  if (!areStoredLines(source)) return Infinity;
  return Math.max(1, Math.floor(maxRepeatedLines / source.instanceCount));
}

export class InstancedGeometry {
  readonly geometry: InstancedBufferGeometry;
  /** The number of shape instances that it has room for. */
  readonly capacity: number;
  readonly #source: BufferGeometry;
  readonly #instanceIndices: InstancedBufferAttribute;
  /** Instances of the geometry per shape instance: the number of wide lines, or 1. */
  readonly #instancesPerShape: number;

  constructor(source: BufferGeometry, capacity: number) {
    this.capacity = capacity;
    this.#source = source;
    this.#instancesPerShape = source instanceof InstancedBufferGeometry ? source.instanceCount : 1;
    this.geometry =
      source instanceof InstancedBufferGeometry
        ? lateWideLines.required.repeatedLines(source, capacity)
        : shareAttributes(source);
    this.geometry.boundingSphere = new Sphere(); // otherwise three.js computes one from stored positions
    // Invalid indices, so that the first call of setInstances writes all.
    this.#instanceIndices = new InstancedBufferAttribute(
      new Uint32Array(capacity).fill(2 ** 32 - 1),
      1,
      false,
      this.#instancesPerShape,
    );
    this.geometry.setAttribute("instanceIndex", this.#instanceIndices);
  }

  /** Sets the instances, at most `capacity`. */
  setInstances(instanceIndices: Uint32Array): void {
    this.geometry.instanceCount = instanceIndices.length * this.#instancesPerShape;
    const previous = this.#instanceIndices.array;
    if (instanceIndices.every((index, n) => previous[n] === index)) return;
    previous.set(instanceIndices);
    this.#instanceIndices.clearUpdateRanges();
    this.#instanceIndices.addUpdateRange(0, instanceIndices.length);
    this.#instanceIndices.needsUpdate = true;
  }

  /** Frees the geometry, but not the buffers that it shares. */
  dispose(): void {
    if (this.geometry.index === this.#source.index) this.geometry.setIndex(null);
    for (const [name, attribute] of Object.entries(this.#source.attributes)) {
      if (this.geometry.getAttribute(name) === attribute) this.geometry.deleteAttribute(name);
    }
    this.geometry.dispose();
  }
}

function areStoredLines(source: BufferGeometry): source is InstancedBufferGeometry {
  return source instanceof InstancedBufferGeometry && Object.keys(source.attributes).length > 0;
}

function shareAttributes(source: BufferGeometry): InstancedBufferGeometry {
  const geometry = new InstancedBufferGeometry();
  for (const [name, attribute] of Object.entries(source.attributes)) geometry.setAttribute(name, attribute);
  geometry.setIndex(source.index);
  geometry.setDrawRange(source.drawRange.start, source.drawRange.count);
  return geometry;
}
