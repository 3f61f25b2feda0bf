// Many small meshes as one, drawn with one call by every browser, where
// WEBGL_multi_draw would need the browser's help.

import type { Frustum } from "three";
import { BufferAttribute, BufferGeometry, Sphere } from "three";
import type { Buffers } from "../buffers.ts";
import type { DrawnObject } from "../drawnObject.ts";
import type { Batch, BatchParts, Member } from "./batch.ts";
import { MergedMesh } from "./mergedMesh.ts";

export class MergedBatch implements Batch {
  readonly #parts: BatchParts;
  readonly #mesh: MergedMesh;
  readonly #object: DrawnObject;
  readonly #sphere = new Sphere();
  #geometry = new BufferGeometry();
  #hasChanged = true;
  #isTouched = true;

  constructor(parts: BatchParts, buffers: Buffers) {
    this.#parts = parts;
    this.#mesh = new MergedMesh(parts.draw, buffers);
    this.#object = parts.hang(this.#geometry);
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
    this.#isTouched = true;
  }

  /** Its triangles become points, until there are so many of them that all is written anew. */
  remove(member: Member): void {
    this.#mesh.remove(member);
    this.#hasChanged = true;
    this.#isTouched = true;
  }

  touch(): void {
    this.#isTouched = true;
  }

  update(frustum: Frustum): void {
    if (this.#isWasteful) this.#mesh.writeAnew();
    if (this.#hasChanged) this.#send();
    if (this.#isTouched) this.#measure();
    this.#object.visible = !this.#sphere.isEmpty() && frustum.intersectsSphere(this.#sphere);
  }

  show(): void {
    throw new RangeError("what does not blend has no order");
  }

  dispose(): void {
    this.#object.removeFromParent();
    this.#geometry.dispose();
    this.#parts.material.dispose();
  }

  get #isWasteful(): boolean {
    // A point that is drawn twice would be seen in a place that is not its own.
    const { lostShare } = this.#mesh;
    return lostShare > 0.5 || (lostShare > 0 && this.#object.type === "Points");
  }

  /** What has been added goes to the GPU with the next frame. */
  #send(): void {
    this.#hasChanged = false;
    this.#geometry.dispose();
    const geometry = new BufferGeometry();
    this.#mesh.setVerticesOf(geometry);
    geometry.setIndex(new BufferAttribute(this.#mesh.index, 1));
    geometry.boundingSphere = this.#sphere;
    this.#geometry = geometry;
    this.#object.geometry = geometry;
  }

  #measure(): void {
    this.#isTouched = false;
    this.#sphere.makeEmpty();
    for (const { isShown, sphere } of this.#mesh.members) if (isShown) this.#sphere.union(sphere);
  }
}
