// A batch of members that have the same draw of a stage: it is drawn with one instance per visible
// member.

import type { BufferGeometry, Frustum } from "three";
import { Sphere } from "three";
import type { DrawnObject } from "../primitives/drawnObject.ts";
import type { GeometryPool } from "../stages/geometryPool.ts";
import type { Batch, BatchResources, Member, Run } from "./batch.ts";
import { passesOf } from "./batch.ts";
import { maxInstancesOf, InstancedGeometry } from "./instancedGeometry.ts";

const sphere = new Sphere();

export class InstancedBatch implements Batch {
  readonly #resources: BatchResources;
  readonly #geometries: GeometryPool;
  readonly #geometry: BufferGeometry;
  readonly #passes: readonly number[];
  readonly #maxInstances: number;
  readonly #members = new Set<Member>();
  /** The last frame used the first ones; the others are invisible. */
  readonly #calls: InstancedCall[] = [];
  /** Used in each frame anew. */
  readonly #visible: Member[] = [];
  #indices = new Uint32Array(0);

  constructor(resources: BatchResources, geometries: GeometryPool) {
    const {
      stage,
      ranges: [range],
    } = resources.draw;
    const geometry = range && geometries.acquire(stage)[stage.draws.indexOf(range)];
    if (geometry === undefined) throw new RangeError("the stage does not have this draw");
    this.#resources = resources;
    this.#geometries = geometries;
    this.#geometry = geometry;
    this.#passes = passesOf(resources.draw);
    this.#maxInstances = maxInstancesOf(geometry);
  }

  get isEmpty(): boolean {
    return this.#members.size === 0;
  }

  hasRoomFor(): boolean {
    return true;
  }

  add(member: Member): void {
    this.#members.add(member);
  }

  remove(member: Member): void {
    this.#members.delete(member);
  }

  invalidateBounds(): void {
    // Nothing is cached: every frame culls by the members' current bounds.
  }

  update(frustum: Frustum): void {
    const visible = this.#visible;
    const { members } = this.#resources;
    visible.length = 0;
    for (const member of this.#members)
      if (member.isVisible && frustum.intersectsSphere(members.sphereOf(member.instanceIndex, sphere)))
        visible.push(member);
    this.drawRuns(visible.length > 0 ? [{ members: visible, order: 0 }] : []);
  }

  drawRuns(runs: readonly Run[]): void {
    let count = 0;
    for (const { members, order } of runs) {
      const indices = this.#indicesOf(members);
      for (let first = 0; first < indices.length; first += this.#maxInstances) {
        const part = indices.subarray(first, first + this.#maxInstances);
        const call = (this.#calls[count] ??= new InstancedCall(this.#geometry, this.#resources, part.length));
        call.show(part, order);
        count += 1;
      }
    }
    for (let n = count; n < this.#calls.length; ++n) {
      const call = this.#calls[n];
      if (call) call.object.visible = false;
    }
  }

  /** The records of the members, once for each pass; valid until the next call. */
  #indicesOf(members: readonly Member[]): Uint32Array {
    const count = members.length * this.#passes.length;
    if (this.#indices.length < count) this.#indices = new Uint32Array(2 * count);
    let n = 0;
    for (const { instanceIndex } of members) for (const pass of this.#passes) this.#indices[n++] = instanceIndex + pass;
    return this.#indices.subarray(0, count);
  }

  dispose(): void {
    for (const call of this.#calls) call.dispose();
    this.#resources.material.dispose();
    this.#geometries.release(this.#resources.draw.stage);
  }
}

/** One draw call, with the indices of its instances. */
class InstancedCall {
  readonly object: DrawnObject;
  readonly #geometry: BufferGeometry;
  #instances: InstancedGeometry;

  constructor(geometry: BufferGeometry, { addObject }: BatchResources, instanceCount: number) {
    this.#geometry = geometry;
    this.#instances = new InstancedGeometry(geometry, instanceCount);
    this.object = addObject(this.#instances.geometry);
  }

  show(instanceIndices: Uint32Array, order: number): void {
    if (instanceIndices.length > this.#instances.capacity) {
      this.#instances.dispose();
      this.#instances = new InstancedGeometry(
        this.#geometry,
        Math.min(maxInstancesOf(this.#geometry), 2 * instanceIndices.length),
      );
      this.object.geometry = this.#instances.geometry;
    }
    this.#instances.setInstances(instanceIndices);
    this.object.visible = true;
    this.object.renderOrder = order;
  }

  dispose(): void {
    this.object.removeFromParent();
    this.#instances.dispose();
  }
}
