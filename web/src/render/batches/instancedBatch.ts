// A draw in many places at once: an instance for each that the camera sees.

import type { BufferGeometry, Frustum } from "three";
import type { DrawnObject } from "../primitives/drawnObject.ts";
import type { GeometryPool } from "../stages/geometryPool.ts";
import type { Batch, BatchResources, Member, Run } from "./batch.ts";
import { passesOf } from "./batch.ts";
import { maxInstancesOf, InstancedGeometry } from "./instancedGeometry.ts";

export class InstancedBatch implements Batch {
  readonly #parts: BatchResources;
  readonly #geometries: GeometryPool;
  readonly #shape: BufferGeometry;
  readonly #passes: readonly number[];
  readonly #mostPlaces: number;
  readonly #members = new Set<Member>();
  /** Those that the last frame has drawn come first. */
  readonly #calls: InstancedCall[] = [];

  constructor(parts: BatchResources, geometries: GeometryPool) {
    const {
      stage,
      ranges: [range],
    } = parts.draw;
    const shape = range && geometries.acquire(stage)[stage.draws.indexOf(range)];
    if (shape === undefined) throw new RangeError("the draw is not one of its stage");
    this.#parts = parts;
    this.#geometries = geometries;
    this.#shape = shape;
    this.#passes = passesOf(parts.draw);
    this.#mostPlaces = maxInstancesOf(shape);
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
    // Every frame looks at all of them.
  }

  update(frustum: Frustum): void {
    const members = Array.from(this.#members).filter(
      ({ isVisible: isShown, sphere }) => isShown && frustum.intersectsSphere(sphere),
    );
    this.drawRuns(members.length > 0 ? [{ members, order: 0 }] : []);
  }

  drawRuns(runs: readonly Run[]): void {
    let count = 0;
    for (const { members, order } of runs) {
      const places = members.flatMap(({ instanceIndex: place }) => this.#passes.map((pass) => place + pass));
      for (let first = 0; first < places.length; first += this.#mostPlaces) {
        const together = places.slice(first, first + this.#mostPlaces);
        const call = (this.#calls[count] ??= new InstancedCall(this.#shape, this.#parts, together.length));
        call.show(together, order);
        count += 1;
      }
    }
    for (const call of this.#calls.slice(count)) call.object.visible = false;
  }

  dispose(): void {
    for (const call of this.#calls) call.dispose();
    this.#parts.material.dispose();
    this.#geometries.release(this.#parts.draw.stage);
  }
}

/** One of its calls, with the numbers of the places that it draws. */
class InstancedCall {
  readonly object: DrawnObject;
  readonly #shape: BufferGeometry;
  #placed: InstancedGeometry;

  constructor(shape: BufferGeometry, { addObject: hang }: BatchResources, placeCount: number) {
    this.#shape = shape;
    this.#placed = new InstancedGeometry(shape, placeCount);
    this.object = hang(this.#placed.geometry);
  }

  show(places: readonly number[], order: number): void {
    if (places.length > this.#placed.capacity) {
      this.#placed.dispose();
      this.#placed = new InstancedGeometry(this.#shape, Math.min(maxInstancesOf(this.#shape), 2 * places.length));
      this.object.geometry = this.#placed.geometry;
    }
    this.#placed.setInstances(places);
    this.object.visible = true;
    this.object.renderOrder = order;
  }

  dispose(): void {
    this.object.removeFromParent();
    this.#placed.dispose();
  }
}
