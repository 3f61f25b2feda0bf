// A draw in many places at once: an instance for each that the camera sees.

import type { BufferGeometry, Frustum } from "three";
import { InstancedBufferAttribute, InstancedBufferGeometry, Sphere } from "three";
import type { DrawnObject } from "../drawnObject.ts";
import type { GeometryPool } from "../stageGeometries.ts";
import type { Batch, BatchParts, Member, Run } from "./batch.ts";
import { passesOf } from "./batch.ts";

const leastInstances = 16;

export class InstancedBatch implements Batch {
  readonly #parts: BatchParts;
  readonly #geometries: GeometryPool;
  readonly #shape: BufferGeometry;
  readonly #passes: readonly number[];
  readonly #members = new Set<Member>();
  /** Those that the last frame has drawn come first. */
  readonly #calls: InstancedCall[] = [];

  constructor(parts: BatchParts, geometries: GeometryPool) {
    const { stage, ranges: [range] } = parts.draw;
    const shape = range && geometries.acquire(stage)[stage.draws.indexOf(range)];
    if (shape === undefined) throw new RangeError("the draw is not one of its stage");
    this.#parts = parts;
    this.#geometries = geometries;
    this.#shape = shape;
    this.#passes = passesOf(parts.draw);
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

  touch(): void {
    // Every frame looks at all of them.
  }

  update(frustum: Frustum): void {
    const members = Array.from(this.#members).filter(({ isShown, sphere }) => isShown && frustum.intersectsSphere(sphere));
    this.show(members.length > 0 ? [{ members, order: 0 }] : []);
  }

  show(runs: readonly Run[]): void {
    runs.forEach((run, n) => { this.#callAt(n).show(run, this.#passes); });
    for (const call of this.#calls.slice(runs.length)) call.object.visible = false;
  }

  dispose(): void {
    for (const call of this.#calls) call.dispose();
    this.#parts.material.dispose();
    this.#geometries.release(this.#parts.draw.stage);
  }

  #callAt(n: number): InstancedCall {
    return this.#calls[n] ??= new InstancedCall(this.#shape, this.#parts);
  }
}

/** One of its calls, with the numbers of the places that it draws. */
class InstancedCall {
  readonly object: DrawnObject;
  readonly #shape: BufferGeometry;
  #geometry: InstancedBufferGeometry;
  #places: InstancedBufferAttribute;

  constructor(shape: BufferGeometry, { hang }: BatchParts) {
    this.#shape = shape;
    [this.#geometry, this.#places] = instancedOf(shape, leastInstances);
    this.object = hang(this.#geometry);
  }

  show({ members, order }: Run, passes: readonly number[]): void {
    const count = members.length * passes.length;
    if (count > this.#places.count) {
      this.#freeGeometry();
      [this.#geometry, this.#places] = instancedOf(this.#shape, Math.max(count, 2 * this.#places.count));
      this.object.geometry = this.#geometry;
    }
    this.object.visible = true;
    this.object.renderOrder = order;
    this.#geometry.instanceCount = count;
    const numbers = this.#places.array;
    let isOther = false;
    let at = 0;
    for (const { place } of members) {
      for (const pass of passes) {
        isOther ||= numbers[at] !== place + pass;
        numbers[at] = place + pass;
        at += 1;
      }
    }
    if (!isOther) return;
    this.#places.clearUpdateRanges();
    this.#places.addUpdateRange(0, count);
    this.#places.needsUpdate = true;
  }

  dispose(): void {
    this.object.removeFromParent();
    this.#freeGeometry();
  }

  /** The stage's buffers stay, that of the places goes. */
  #freeGeometry(): void {
    this.#geometry.setIndex(null);
    for (const name of Object.keys(this.#geometry.attributes)) if (name !== "place") this.#geometry.deleteAttribute(name);
    this.#geometry.dispose();
  }
}

function instancedOf(shape: BufferGeometry, capacity: number): [InstancedBufferGeometry, InstancedBufferAttribute] {
  const geometry = new InstancedBufferGeometry();
  for (const [name, attribute] of Object.entries(shape.attributes)) geometry.setAttribute(name, attribute);
  geometry.setIndex(shape.index);
  geometry.setDrawRange(shape.drawRange.start, shape.drawRange.count);
  geometry.boundingSphere = new Sphere(); // three.js would make one of the stored numbers
  // Of no place: the first frame writes them all.
  const places = new InstancedBufferAttribute(new Uint32Array(capacity).fill(2 ** 32 - 1), 1);
  geometry.setAttribute("place", places);
  return [geometry, places];
}
