// Instanced draws: one draw of a stage, with one instance per visible member.

import type { BufferGeometry, Frustum } from "three";
import type { DrawnObject } from "../primitives/drawnObject.ts";
import type { GeometryPool } from "../stages/geometryPool.ts";
import type { Batch, BatchResources, Member, Run } from "./batch.ts";
import { passesOf } from "./batch.ts";
import { maxInstancesOf, InstancedGeometry } from "./instancedGeometry.ts";

export class InstancedBatch implements Batch {
  readonly #resources: BatchResources;
  readonly #geometries: GeometryPool;
  readonly #shape: BufferGeometry;
  readonly #passes: readonly number[];
  readonly #maxInstances: number;
  readonly #members = new Set<Member>();
  /** The first ones have been drawn in the last frame; the others are invisible. */
  readonly #calls: InstancedCall[] = [];

  constructor(resources: BatchResources, geometries: GeometryPool) {
    const {
      stage,
      ranges: [range],
    } = resources.draw;
    const shape = range && geometries.acquire(stage)[stage.draws.indexOf(range)];
    if (shape === undefined) throw new RangeError("the draw is not one of its stage");
    this.#resources = resources;
    this.#geometries = geometries;
    this.#shape = shape;
    this.#passes = passesOf(resources.draw);
    this.#maxInstances = maxInstancesOf(shape);
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
    // Every frame culls all members.
  }

  update(frustum: Frustum): void {
    const members = Array.from(this.#members).filter(
      ({ isVisible, sphere }) => isVisible && frustum.intersectsSphere(sphere),
    );
    this.drawRuns(members.length > 0 ? [{ members, order: 0 }] : []);
  }

  drawRuns(runs: readonly Run[]): void {
    let count = 0;
    for (const { members, order } of runs) {
      const instanceIndices = members.flatMap(({ instanceIndex }) => this.#passes.map((pass) => instanceIndex + pass));
      for (let first = 0; first < instanceIndices.length; first += this.#maxInstances) {
        const indices = instanceIndices.slice(first, first + this.#maxInstances);
        const call = (this.#calls[count] ??= new InstancedCall(this.#shape, this.#resources, indices.length));
        call.show(indices, order);
        count += 1;
      }
    }
    for (const call of this.#calls.slice(count)) call.object.visible = false;
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
  readonly #shape: BufferGeometry;
  #instances: InstancedGeometry;

  constructor(shape: BufferGeometry, { addObject }: BatchResources, instanceCount: number) {
    this.#shape = shape;
    this.#instances = new InstancedGeometry(shape, instanceCount);
    this.object = addObject(this.#instances.geometry);
  }

  show(instanceIndices: readonly number[], order: number): void {
    if (instanceIndices.length > this.#instances.capacity) {
      this.#instances.dispose();
      this.#instances = new InstancedGeometry(
        this.#shape,
        Math.min(maxInstancesOf(this.#shape), 2 * instanceIndices.length),
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
