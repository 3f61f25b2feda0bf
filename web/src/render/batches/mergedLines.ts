// Merges wide lines of several shapes into instances of one outline, each with both ends of the line
// and the index of its instance record.

import type { BufferGeometry } from "three";
import { InstancedBufferAttribute } from "three";
import type { BufferStage } from "../../stage/stage.ts";
import type { BufferProvider } from "../uploads/bufferProvider.ts";
import { lateWideLines } from "../lines/lateWideLines.ts";
import type { LineRecords } from "../lines/wideLineGeometry.ts";
import { lineCountOf } from "../lines/wideLines.ts";
import type { BatchedDraw, Member, MergedGeometry } from "./batch.ts";
import { GrowingArray } from "../attributes/growingArray.ts";

/** The maximum number of lines in one draw. All are uploaded again whenever one is added or removed. */
const maxLines = 65536;

export class MergedLines implements MergedGeometry {
  readonly #buffers: BufferProvider;
  readonly #records: LineRecords;
  readonly #instanceIndices = new GrowingArray(Uint32Array);
  readonly #members = new Set<Member>();
  #hasRemovedMembers = false;

  /** For draws whose stages have the same `layoutOf` key. */
  constructor({ stage }: BatchedDraw, buffers: BufferProvider) {
    this.#buffers = buffers;
    this.#records = lateWideLines.required.recordsFor(stage as BufferStage);
  }

  get members(): Iterable<Member> {
    return this.#members;
  }

  get isEmpty(): boolean {
    return this.#members.size === 0;
  }

  /** Lines of removed members would still be visible. */
  get needsRebuild(): boolean {
    return this.#hasRemovedMembers;
  }

  hasRoomFor({ draw: { ranges } }: Member): boolean {
    return this.#instanceIndices.length + ranges.reduce((sum, range) => sum + lineCountOf(range), 0) <= maxLines;
  }

  add(member: Member): void {
    const { ranges, stage } = member.draw;
    for (const range of ranges) {
      this.#records.add(stage as BufferStage, range, this.#buffers);
      this.#instanceIndices.extend(lineCountOf(range)).fill(member.instanceIndex);
    }
    this.#members.add(member);
  }

  remove(member: Member): void {
    this.#members.delete(member);
    this.#hasRemovedMembers = true;
  }

  rebuild(): void {
    this.#hasRemovedMembers = false;
    this.#records.clear();
    this.#instanceIndices.clear();
    for (const member of this.#members) this.add(member);
  }

  makeGeometry(): BufferGeometry {
    const geometry = lateWideLines.required.outlineGeometry(this.#instanceIndices.length);
    this.#records.setOn(geometry);
    geometry.setAttribute("instanceIndex", new InstancedBufferAttribute(this.#instanceIndices.used, 1));
    return geometry;
  }
}
