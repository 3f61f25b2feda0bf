// A batch that merges small transparent meshes into one. Its index holds the members in draw order,
// and is rewritten when the order changes; each run draws a range of it.

import { BufferAttribute, BufferGeometry, DynamicDrawUsage, Sphere } from "three";
import type { BufferProvider } from "../uploads/bufferProvider.ts";
import type { DrawnObject } from "../primitives/drawnObject.ts";
import type { BatchResources, Member, Run } from "./batch.ts";
import { MergedMesh } from "./mergedMesh.ts";
import { MergingBatch } from "./mergingBatch.ts";

export class OrderedMergedBatch extends MergingBatch<MergedMesh> {
  /** By run; as many as the frame with the most runs had. Those that a frame does not need are invisible. */
  readonly #objects: DrawnObject[] = [];
  /** Owns the vertices, which the geometries of all objects share. */
  #vertices = new BufferGeometry();
  /** The index of all objects. */
  #index = new BufferAttribute(new Uint16Array(), 1);
  /** The members in the order of the index. */
  #order: readonly Member[] = [];

  constructor(resources: BatchResources, buffers: BufferProvider) {
    super(resources, new MergedMesh(resources.draw, buffers));
  }

  invalidateBounds(): void {
    // Nothing is cached: every frame culls and sorts by the members' current bounds.
  }

  update(): void {
    throw new RangeError("transparent members are drawn with drawRuns");
  }

  drawRuns(runs: readonly Run[]): void {
    if (this.hasChanged) this.#replaceGeometries();
    const members = runs.flatMap((run) => run.members);
    if (members.length !== this.#order.length || members.some((member, n) => member !== this.#order[n]))
      this.#writeIndex(members);
    let first = 0;
    runs.forEach((run, n) => {
      const object = this.#objectAt(n);
      const count = run.members.reduce((sum, member) => sum + this.merged.indicesOf(member).length, 0);
      object.geometry.setDrawRange(first, count);
      object.renderOrder = run.order;
      object.visible = true;
      first += count;
    });
    for (const object of this.#objects.slice(runs.length)) object.visible = false;
  }

  dispose(): void {
    for (const object of this.#objects) {
      object.removeFromParent();
      object.geometry.dispose();
    }
    this.#vertices.dispose();
    this.resources.material.dispose();
  }

  #objectAt(n: number): DrawnObject {
    return (this.#objects[n] ??= this.resources.addObject(this.#makeGeometry()));
  }

  /** Replaces the vertices and the index, which three.js uploads with the next frame. */
  #replaceGeometries(): void {
    this.hasChanged = false;
    if (this.merged.removedFraction > 0.5) this.merged.rebuild();
    for (const { geometry } of this.#objects) geometry.dispose();
    this.#vertices.dispose();
    this.#vertices = new BufferGeometry();
    this.merged.setVerticesOf(this.#vertices);
    this.#index = new BufferAttribute(new Uint16Array(this.merged.index.length), 1).setUsage(DynamicDrawUsage);
    this.#order = [];
    for (const object of this.#objects) object.geometry = this.#makeGeometry();
  }

  /** Makes a geometry with the common vertices and the common index. */
  #makeGeometry(): BufferGeometry {
    const geometry = new BufferGeometry();
    for (const [name, attribute] of Object.entries(this.#vertices.attributes)) geometry.setAttribute(name, attribute);
    geometry.setIndex(this.#index);
    geometry.boundingSphere = new Sphere(); // otherwise three.js computes one from stored positions
    return geometry;
  }

  #writeIndex(members: readonly Member[]): void {
    const { array } = this.#index;
    let first = 0;
    for (const member of members) {
      const indices = this.merged.indicesOf(member);
      (array as Uint16Array).set(indices, first);
      first += indices.length;
    }
    this.#order = members;
    this.#index.clearUpdateRanges();
    this.#index.addUpdateRange(0, first);
    this.#index.needsUpdate = true;
  }
}
