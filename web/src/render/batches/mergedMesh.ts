// Many small meshes as one: their vertices one after the other, each with the
// number of its place, and the indices of each mesh together.

import { BufferAttribute, BufferGeometry } from "three";
import type { BufferStage, DrawRange } from "../../stage/stage.ts";
import type { BufferProvider } from "../uploads/bufferProvider.ts";
import type { BatchedDraw, Member, MergedGeometry } from "./batch.ts";
import { passesOf } from "./batch.ts";
import { GrowingArray } from "../attributes/growingArray.ts";
import type { Column } from "../attributes/vertexColumns.ts";
import { appendVertices, attributeOf, columnsOf, indicesOf } from "../attributes/vertexColumns.ts";

/** The largest 16-bit number means another primitive to WebGL. */
export const maxVertices = 65535;

interface Entry {
  readonly firstIndex: number;
  readonly indexCount: number;
}

export class MergedMesh implements MergedGeometry {
  readonly #primitive: DrawRange["primitive"];
  readonly #buffers: BufferProvider;
  readonly #columns: readonly Column[];
  readonly #places = new GrowingArray(Uint32Array);
  readonly #index = new GrowingArray(Uint16Array);
  readonly #entries = new Map<Member, Entry>();
  /** Of members that are gone. */
  #lostIndices = 0;

  /** For draws that are like this one in all that `layoutOf` says. */
  constructor({ stage, request }: BatchedDraw, buffers: BufferProvider) {
    this.#primitive = request.primitive;
    this.#buffers = buffers;
    this.#columns = columnsOf(stage as BufferStage);
  }

  get members(): Iterable<Member> {
    return this.#entries.keys();
  }

  get isEmpty(): boolean {
    return this.#entries.size === 0;
  }

  /** The share of its indices that belong to nobody, 0 … 1. */
  get lostShare(): number {
    return this.#lostIndices === 0 ? 0 : this.#lostIndices / this.#index.length;
  }

  get needsRebuild(): boolean {
    // A point that is drawn twice would be seen in a place that is not its own.
    return this.lostShare > 0.5 || (this.lostShare > 0 && this.#primitive === "points");
  }

  /** Of all members; those that are gone have left points, which show nothing. */
  get index(): Uint16Array<ArrayBuffer> {
    return this.#index.used;
  }

  indicesOf(member: Member): Uint16Array {
    const { firstIndex, indexCount } = this.#entries.get(member) ?? { firstIndex: 0, indexCount: 0 };
    return this.#index.used.subarray(firstIndex, firstIndex + indexCount);
  }

  hasRoomFor({ draw }: Member): boolean {
    return this.#places.length + draw.vertexCount * passesOf(draw).length <= maxVertices;
  }

  add(member: Member): void {
    const { ranges, vertexCount } = member.draw;
    const stage = member.draw.stage as BufferStage;
    const indices = indicesOf(stage, ranges, this.#buffers);
    const firstIndex = this.#index.length;
    for (const pass of passesOf(member.draw)) {
      const firstVertex = this.#places.length;
      for (const column of this.#columns) appendVertices(column, stage, vertexCount, this.#buffers);
      this.#places.extend(vertexCount).fill(member.instanceIndex + pass);
      const own = this.#index.extend(indices.length);
      // Whatever a file says, it does not name others' vertices.
      for (let i = 0; i < indices.length; ++i) own[i] = firstVertex + Math.min(indices[i] ?? 0, vertexCount - 1);
    }
    this.#entries.set(member, { firstIndex, indexCount: this.#index.length - firstIndex });
  }

  /** Its triangles become points, until there are so many of them that all is written anew. */
  remove(member: Member): void {
    const own = this.indicesOf(member);
    own.fill(0);
    this.#lostIndices += own.length;
    this.#entries.delete(member);
  }

  rebuild(): void {
    const members = Array.from(this.#entries.keys());
    this.#entries.clear();
    for (const { data } of this.#columns) data.clear();
    this.#places.clear();
    this.#index.clear();
    this.#lostIndices = 0;
    for (const member of members) this.add(member);
  }

  makeGeometry(): BufferGeometry {
    const geometry = new BufferGeometry();
    this.setVerticesOf(geometry);
    geometry.setIndex(new BufferAttribute(this.index, 1));
    return geometry;
  }

  /** Valid until it grows: they share its memory. */
  setVerticesOf(geometry: BufferGeometry): void {
    for (const column of this.#columns) geometry.setAttribute(column.name, attributeOf(column));
    geometry.setAttribute("instanceIndex", new BufferAttribute(this.#places.used, 1));
  }
}
