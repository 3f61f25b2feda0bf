// Small meshes merged into one, drawn with one call in every browser, also where WEBGL_multi_draw
// is missing.

import type { Frustum } from "three";
import { BufferGeometry, Sphere } from "three";
import type { BufferProvider } from "../uploads/bufferProvider.ts";
import type { DrawnObject } from "../primitives/drawnObject.ts";
import type { Batch, BatchResources, Member, MergedGeometry } from "./batch.ts";
import { MergedLines } from "./mergedLines.ts";
import { MergedMesh } from "./mergedMesh.ts";

export class MergedBatch implements Batch {
  readonly #resources: BatchResources;
  readonly #mesh: MergedGeometry;
  readonly #object: DrawnObject;
  readonly #sphere = new Sphere();
  #geometry = new BufferGeometry();
  #hasChanged = true;
  #isTouched = true;

  constructor(resources: BatchResources, buffers: BufferProvider) {
    this.#resources = resources;
    this.#mesh =
      resources.draw.request.wideLineStep > 0
        ? new MergedLines(resources.draw, buffers)
        : new MergedMesh(resources.draw, buffers);
    this.#object = resources.addObject(this.#geometry);
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

  remove(member: Member): void {
    this.#mesh.remove(member);
    this.#hasChanged = true;
    this.#isTouched = true;
  }

  invalidateBounds(): void {
    this.#isTouched = true;
  }

  update(frustum: Frustum): void {
    if (this.#mesh.needsRebuild) this.#mesh.rebuild();
    if (this.#hasChanged) this.#send();
    if (this.#isTouched) this.#measure();
    this.#object.visible = !this.#sphere.isEmpty() && frustum.intersectsSphere(this.#sphere);
  }

  drawRuns(): void {
    throw new RangeError("what does not blend has no order");
  }

  dispose(): void {
    this.#object.removeFromParent();
    this.#geometry.dispose();
    this.#resources.material.dispose();
  }

  /** Makes a new geometry, which three.js uploads with the next frame. */
  #send(): void {
    this.#hasChanged = false;
    this.#geometry.dispose();
    const geometry = this.#mesh.makeGeometry();
    geometry.boundingSphere = this.#sphere;
    this.#geometry = geometry;
    this.#object.geometry = geometry;
  }

  #measure(): void {
    this.#isTouched = false;
    this.#sphere.makeEmpty();
    for (const { isVisible, sphere } of this.#mesh.members) if (isVisible) this.#sphere.union(sphere);
  }
}
