// Many small meshes as one: their vertices one after the other, each with the
// number of its place, and one index for all of them. It is drawn with one call by
// every browser, where WEBGL_multi_draw would need the browser's help.

import type { Frustum, Material } from "three";
import { BufferAttribute, BufferGeometry, Sphere } from "three";
import type { BufferStage } from "../../decode/stage.ts";
import type { Buffers } from "../buffers.ts";
import type { DrawnObject } from "../drawnObject.ts";
import { objectOf } from "../drawnObject.ts";
import type { Batch, BatchedDraw, Member } from "./batch.ts";
import { GrowingArray } from "./growingArray.ts";
import type { Column } from "./meshColumns.ts";
import { appendVertices, attributeOf, columnsOf, indicesOf } from "./meshColumns.ts";

/** The largest 16-bit number means another primitive to WebGL. */
export const mostVertices = 65535;

interface Entry {
  readonly firstIndex: number;
  readonly indexCount: number;
}

export class MergedBatch implements Batch {
  readonly object: DrawnObject;
  readonly #buffers: Buffers;
  readonly #material: Material;
  readonly #columns: readonly Column[];
  readonly #places = new GrowingArray(Uint32Array);
  readonly #index = new GrowingArray(Uint16Array);
  readonly #entries = new Map<Member, Entry>();
  readonly #sphere = new Sphere();
  #geometry = new BufferGeometry();
  /** Of members that are gone. */
  #lostIndices = 0;
  #hasChanged = true;
  #isTouched = true;

  /** For draws that are like this one in all that `layoutOf` says. */
  constructor({ stage, request }: BatchedDraw, material: Material, buffers: Buffers) {
    this.#buffers = buffers;
    this.#material = material;
    this.#columns = columnsOf(stage as BufferStage);
    this.object = objectOf(request, this.#geometry, material);
  }

  get isEmpty(): boolean {
    return this.#entries.size === 0;
  }

  hasRoomFor({ draw: { vertexCount } }: Member): boolean {
    return this.#places.length + vertexCount <= mostVertices;
  }

  add(member: Member): void {
    const { ranges, vertexCount } = member.draw;
    const stage = member.draw.stage as BufferStage;
    const firstVertex = this.#places.length;
    for (const column of this.#columns) appendVertices(column, stage, vertexCount, this.#buffers);
    this.#places.extend(vertexCount).fill(member.place);
    const indices = indicesOf(stage, ranges, this.#buffers);
    const firstIndex = this.#index.length;
    const own = this.#index.extend(indices.length);
    // Whatever a file says, it does not name others' vertices.
    for (let i = 0; i < indices.length; ++i) own[i] = firstVertex + Math.min(indices[i] ?? 0, vertexCount - 1);
    this.#entries.set(member, { firstIndex, indexCount: indices.length });
    this.#hasChanged = true;
    this.#isTouched = true;
  }

  /** Its triangles become points, which show nothing, until there are so many of them that all is written anew. */
  remove(member: Member): void {
    const entry = this.#entries.get(member);
    if (entry === undefined) return;
    this.#entries.delete(member);
    const { firstIndex, indexCount } = entry;
    this.#index.used.fill(0, firstIndex, firstIndex + indexCount);
    this.#lostIndices += indexCount;
    this.#hasChanged = true;
    this.#isTouched = true;
  }

  touch(): void {
    this.#isTouched = true;
  }

  update(frustum: Frustum): void {
    if (this.#isWasteful) this.#writeAnew();
    if (this.#hasChanged) this.#send();
    if (this.#isTouched) this.#measure();
    this.object.visible = !this.#sphere.isEmpty() && frustum.intersectsSphere(this.#sphere);
  }

  dispose(): void {
    this.object.removeFromParent();
    this.#geometry.dispose();
    this.#material.dispose();
  }

  get #isWasteful(): boolean {
    // A point that is drawn twice would be seen in a place that is not its own.
    return 2 * this.#lostIndices > this.#index.length || (this.#lostIndices > 0 && this.object.type === "Points");
  }

  #writeAnew(): void {
    const members = Array.from(this.#entries.keys());
    this.#entries.clear();
    for (const { data } of this.#columns) data.clear();
    this.#places.clear();
    this.#index.clear();
    this.#lostIndices = 0;
    for (const member of members) this.add(member);
  }

  /** What has been added goes to the GPU with the next frame. */
  #send(): void {
    this.#hasChanged = false;
    this.#geometry.dispose();
    const geometry = new BufferGeometry();
    for (const column of this.#columns) geometry.setAttribute(column.name, attributeOf(column));
    geometry.setAttribute("place", new BufferAttribute(this.#places.used, 1));
    geometry.setIndex(new BufferAttribute(this.#index.used, 1));
    geometry.boundingSphere = this.#sphere;
    this.#geometry = geometry;
    this.object.geometry = geometry;
  }

  #measure(): void {
    this.#isTouched = false;
    this.#sphere.makeEmpty();
    for (const { isShown, sphere } of this.#entries.keys()) if (isShown) this.#sphere.union(sphere);
  }
}
