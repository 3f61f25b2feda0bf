// Merges small meshes into one geometry: their vertices, one mesh after the other, each vertex with
// the index of its instance record, and one common index.

import { BufferAttribute, BufferGeometry } from "three";
import type { BufferStage, DrawRange } from "../../stage/stage.ts";
import type { BufferProvider } from "../uploads/bufferProvider.ts";
import type { BatchedDraw, Member, MergedGeometry } from "./batch.ts";
import { passesOf } from "./batch.ts";
import { GrowingArray } from "../attributes/growingArray.ts";
import type { Column } from "../attributes/vertexColumns.ts";
import { appendVertices, attributeOf, columnsOf, indicesOf } from "../attributes/vertexColumns.ts";

/** Not 65,536, since index 65,535 is WebGL's primitive restart. */
export const maxVertices = 65535;

interface Entry {
  readonly firstIndex: number;
  readonly indexCount: number;
}

export class MergedMesh implements MergedGeometry {
  readonly #primitive: DrawRange["primitive"];
  readonly #buffers: BufferProvider;
  readonly #columns: readonly Column[];
  readonly #instanceIndices = new GrowingArray(Uint32Array);
  readonly #index = new GrowingArray(Uint16Array);
  readonly #entries = new Map<Member, Entry>();
  /** The number of indices that belong to removed members. */
  #removedIndexCount = 0;

  /** For draws whose stages have the same `layoutOf` key. */
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

  /** The fraction of indices that belong to removed members, 0 … 1. */
  get removedFraction(): number {
    return this.#removedIndexCount === 0 ? 0 : this.#removedIndexCount / this.#index.length;
  }

  get needsRebuild(): boolean {
    // Indices of removed members point to vertex 0: degenerate triangles, but visible points.
    return this.removedFraction > 0.5 || (this.removedFraction > 0 && this.#primitive === "points");
  }

  /** The common index, in which the indices of removed members are 0. */
  get index(): Uint16Array<ArrayBuffer> {
    return this.#index.used;
  }

  /** The range of the common index that belongs to a member. */
  indicesOf(member: Member): Uint16Array {
    const { firstIndex, indexCount } = this.#entries.get(member) ?? { firstIndex: 0, indexCount: 0 };
    return this.#index.used.subarray(firstIndex, firstIndex + indexCount);
  }

  hasRoomFor({ draw }: Member): boolean {
    return this.#instanceIndices.length + draw.vertexCount * passesOf(draw).length <= maxVertices;
  }

  add(member: Member): void {
    const { ranges, vertexCount } = member.draw;
    const stage = member.draw.stage as BufferStage;
    const indices = indicesOf(stage, ranges, this.#buffers);
    const firstIndex = this.#index.length;
    for (const pass of passesOf(member.draw)) {
      const firstVertex = this.#instanceIndices.length;
      for (const column of this.#columns) appendVertices(column, stage, vertexCount, this.#buffers);
      this.#instanceIndices.extend(vertexCount).fill(member.instanceIndex + pass);
      const memberIndices = this.#index.extend(indices.length);
      // Indices of a damaged file must not refer to another mesh's vertices.
      for (let i = 0; i < indices.length; ++i)
        memberIndices[i] = firstVertex + Math.min(indices[i] ?? 0, vertexCount - 1);
    }
    this.#entries.set(member, { firstIndex, indexCount: this.#index.length - firstIndex });
  }

  /** Makes the member's triangles degenerate; `rebuild` removes them. */
  remove(member: Member): void {
    const memberIndices = this.indicesOf(member);
    memberIndices.fill(0);
    this.#removedIndexCount += memberIndices.length;
    this.#entries.delete(member);
  }

  rebuild(): void {
    const members = Array.from(this.#entries.keys());
    this.#entries.clear();
    for (const { data } of this.#columns) data.clear();
    this.#instanceIndices.clear();
    this.#index.clear();
    this.#removedIndexCount = 0;
    for (const member of members) this.add(member);
  }

  makeGeometry(): BufferGeometry {
    const geometry = new BufferGeometry();
    this.setVerticesOf(geometry);
    geometry.setIndex(new BufferAttribute(this.index, 1));
    return geometry;
  }

  /**
   * Sets the vertex attributes of a geometry. They share memory with this object, and are valid until the next `add`.
   */
  setVerticesOf(geometry: BufferGeometry): void {
    for (const column of this.#columns) geometry.setAttribute(column.name, attributeOf(column));
    geometry.setAttribute("instanceIndex", new BufferAttribute(this.#instanceIndices.used, 1));
  }
}
