// A batch that merges small opaque meshes, or wide lines, into one geometry and draws it with one call
// in every browser, also where WEBGL_multi_draw is missing.

import type { Frustum } from "three";
import { Box3, BufferGeometry, Sphere } from "three";
import type { BufferProvider } from "../uploads/bufferProvider.ts";
import type { DrawnObject } from "../primitives/drawnObject.ts";
import type { BatchResources, MergedGeometry } from "./batch.ts";
import { MergedLines } from "./mergedLines.ts";
import { MergedMesh } from "./mergedMesh.ts";
import { MergingBatch } from "./mergingBatch.ts";

const memberSphere = new Sphere();

export class MergedBatch extends MergingBatch<MergedGeometry> {
  readonly #object: DrawnObject;
  readonly #box = new Box3();
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
    this.#box.makeEmpty();
    for (const { isVisible, instanceIndex } of this.merged.members)
      if (isVisible) extendBySphere(this.#box, this.resources.members.sphereOf(instanceIndex, memberSphere));
    const { center } = this.#sphere;
    this.#box.getCenter(center);
    this.#sphere.radius = -1; // empty
    for (const { isVisible, instanceIndex } of this.merged.members) {
      if (!isVisible) continue;
      const member = this.resources.members.sphereOf(instanceIndex, memberSphere);
      this.#sphere.radius = Math.max(this.#sphere.radius, center.distanceTo(member.center) + member.radius);
    }
  }
}

/** Without the objects of three.js' union of spheres: members may move in every frame. */
function extendBySphere({ min, max }: Box3, { center: { x, y, z }, radius }: Sphere): void {
  min.set(Math.min(min.x, x - radius), Math.min(min.y, y - radius), Math.min(min.z, z - radius));
  max.set(Math.max(max.x, x + radius), Math.max(max.y, y + radius), Math.max(max.z, z + radius));
}
