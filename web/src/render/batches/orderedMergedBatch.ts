// Many small meshes that blend, as one: their indices are laid out in the order in
// which a frame draws them, and each run of them is a part of that.

import { BufferAttribute, BufferGeometry, DynamicDrawUsage, Sphere } from "three";
import type { BufferProvider } from "../uploads/bufferProvider.ts";
import type { DrawnObject } from "../primitives/drawnObject.ts";
import type { Batch, BatchResources, Member, Run } from "./batch.ts";
import { MergedMesh } from "./mergedMesh.ts";

export class OrderedMergedBatch implements Batch {
  readonly #parts: BatchResources;
  readonly #mesh: MergedMesh;
  /** An object for each run that there has been in a frame. */
  readonly #objects: DrawnObject[] = [];
  /** Has the vertices; those of the objects share them, and the index. */
  #vertices = new BufferGeometry();
  #index = new BufferAttribute(new Uint16Array(), 1);
  /** In the order of the index. */
  #laid: readonly Member[] = [];
  #hasChanged = true;

  constructor(parts: BatchResources, buffers: BufferProvider) {
    this.#parts = parts;
    this.#mesh = new MergedMesh(parts.draw, buffers);
  }

  get isEmpty(): boolean {
    return this.#mesh.isEmpty;
  }

  hasRoomFor(member: Member): boolean {
    return this.#mesh.hasRoomFor(member);
  }

  add(member: Member): void {
    this.#mesh.add(member);
    this.#hasChanged = true;
  }

  remove(member: Member): void {
    this.#mesh.remove(member);
    this.#hasChanged = true;
  }

  invalidateBounds(): void {
    // Every frame looks at all of them.
  }

  update(): void {
    throw new RangeError("what blends is drawn in an order");
  }

  drawRuns(runs: readonly Run[]): void {
    if (this.#hasChanged) this.#send();
    const members = runs.flatMap((run) => run.members);
    if (members.length !== this.#laid.length || members.some((member, n) => member !== this.#laid[n]))
      this.#lay(members);
    let first = 0;
    runs.forEach((run, n) => {
      const object = this.#objectAt(n);
      const count = run.members.reduce((sum, member) => sum + this.#mesh.indicesOf(member).length, 0);
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
    this.#parts.material.dispose();
  }

  #objectAt(n: number): DrawnObject {
    return (this.#objects[n] ??= this.#parts.addObject(this.#shared()));
  }

  /** What has been added goes to the GPU with the next frame. */
  #send(): void {
    this.#hasChanged = false;
    if (this.#mesh.lostShare > 0.5) this.#mesh.rebuild();
    for (const { geometry } of this.#objects) geometry.dispose();
    this.#vertices.dispose();
    this.#vertices = new BufferGeometry();
    this.#mesh.setVerticesOf(this.#vertices);
    this.#index = new BufferAttribute(new Uint16Array(this.#mesh.index.length), 1).setUsage(DynamicDrawUsage);
    this.#laid = [];
    for (const object of this.#objects) object.geometry = this.#shared();
  }

  #shared(): BufferGeometry {
    const geometry = new BufferGeometry();
    for (const [name, attribute] of Object.entries(this.#vertices.attributes)) geometry.setAttribute(name, attribute);
    geometry.setIndex(this.#index);
    geometry.boundingSphere = new Sphere(); // three.js would make one of the stored numbers
    return geometry;
  }

  #lay(members: readonly Member[]): void {
    const { array } = this.#index;
    let first = 0;
    for (const member of members) {
      const indices = this.#mesh.indicesOf(member);
      (array as Uint16Array).set(indices, first);
      first += indices.length;
    }
    this.#laid = members;
    this.#index.clearUpdateRanges();
    this.#index.addUpdateRange(0, first);
    this.#index.needsUpdate = true;
  }
}
