// A batch that merges small opaque meshes, or wide lines, into one geometry and draws it with one call
// in every browser, also where WEBGL_multi_draw is missing.

import type { Frustum, Vector3 } from "three";
import { Box3, BufferGeometry, Sphere } from "three";
import type { BufferProvider } from "../uploads/bufferProvider.ts";
import type { DrawnObject } from "../primitives/drawnObject.ts";
import type { BatchResources, MergedGeometry } from "./batch.ts";
import { MergedLines } from "./mergedLines.ts";
import { MergedMesh } from "./mergedMesh.ts";
import { memberFields, numbersPerMember } from "./memberTable.ts";
import { MergingBatch } from "./mergingBatch.ts";

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
    const { numbers } = this.resources.members;
    this.#box.makeEmpty();
    for (const { isVisible, instanceIndex } of this.merged.members)
      if (isVisible) extendBySphere(this.#box, numbers, sphereAt(instanceIndex));
    this.#box.getCenter(this.#sphere.center);
    let radius = -1; // empty
    for (const { isVisible, instanceIndex } of this.merged.members) {
      if (!isVisible) continue;
      const at = sphereAt(instanceIndex);
      const distance = distanceTo(this.#sphere.center, numbers, at);
      radius = Math.max(radius, distance + number(numbers, at + 3));
    }
    this.#sphere.radius = radius;
  }
}

/** Where a member's bounding sphere begins in the table of the members. */
function sphereAt(instanceIndex: number): number {
  return instanceIndex * numbersPerMember + memberFields.sphere;
}

function number(numbers: Float64Array, at: number): number {
  return numbers[at] ?? NaN;
}

function distanceTo({ x, y, z }: Vector3, numbers: Float64Array, at: number): number {
  const dx = number(numbers, at) - x;
  const dy = number(numbers, at + 1) - y;
  const dz = number(numbers, at + 2) - z;
  return Math.sqrt(dx * dx + dy * dy + dz * dz); // Math.hypot takes several times as long
}

/** Without the objects of three.js' union of spheres: members may move in every frame. */
function extendBySphere({ min, max }: Box3, numbers: Float64Array, at: number): void {
  const x = number(numbers, at);
  const y = number(numbers, at + 1);
  const z = number(numbers, at + 2);
  const radius = number(numbers, at + 3);
  min.set(Math.min(min.x, x - radius), Math.min(min.y, y - radius), Math.min(min.z, z - radius));
  max.set(Math.max(max.x, x + radius), Math.max(max.y, y + radius), Math.max(max.z, z + radius));
}
