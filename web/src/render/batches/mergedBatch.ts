// A batch that merges small opaque meshes, or wide lines, into one geometry and draws it with one call
// in every browser, also where WEBGL_multi_draw is missing.

import type { Frustum } from "three";
import { BufferGeometry, Sphere } from "three";
import type { BufferProvider } from "../uploads/bufferProvider.ts";
import type { DrawnObject } from "../primitives/drawnObject.ts";
import type { BatchResources, MergedGeometry } from "./batch.ts";
import { MergedLines } from "./mergedLines.ts";
import { MergedMesh } from "./mergedMesh.ts";
import { MergingBatch } from "./mergingBatch.ts";

export class MergedBatch extends MergingBatch<MergedGeometry> {
  readonly #object: DrawnObject;
  readonly #sphere = new Sphere();
  #geometry = new BufferGeometry();
  #areBoundsCurrent = false;

  constructor(resources: BatchResources, buffers: BufferProvider) {
    super(
      resources,
      resources.draw.request.wideLineStep > 0
        ? new MergedLines(resources.draw, buffers)
        : new MergedMesh(resources.draw, buffers),
    );
    this.#object = resources.addObject(this.#geometry);
  }

  invalidateBounds(): void {
    this.#areBoundsCurrent = false;
  }

  update(frustum: Frustum): void {
    if (this.merged.needsRebuild) this.merged.rebuild();
    if (this.hasChanged) this.#replaceGeometry();
    if (!this.#areBoundsCurrent) this.#computeBounds();
    this.#object.visible = !this.#sphere.isEmpty() && frustum.intersectsSphere(this.#sphere);
  }

  drawRuns(): void {
    throw new RangeError("opaque members are drawn with update");
  }

  dispose(): void {
    this.#object.removeFromParent();
    this.#geometry.dispose();
    this.resources.material.dispose();
  }

  /** Makes a new geometry, which three.js uploads with the next frame. */
  #replaceGeometry(): void {
    this.hasChanged = false;
    this.#areBoundsCurrent = false;
    this.#geometry.dispose();
    const geometry = this.merged.makeGeometry();
    geometry.boundingSphere = this.#sphere;
    this.#geometry = geometry;
    this.#object.geometry = geometry;
  }

  #computeBounds(): void {
    this.#areBoundsCurrent = true;
    this.#sphere.makeEmpty();
    for (const { isVisible, sphere } of this.merged.members) if (isVisible) this.#sphere.union(sphere);
  }
}
