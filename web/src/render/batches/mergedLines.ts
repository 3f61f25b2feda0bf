// Wide lines of many shapes as those of one: instances of one outline, each with
// both its ends and the number of its place.

import type { BufferGeometry } from "three";
import { InstancedBufferAttribute } from "three";
import type { BufferStage } from "../../stage/stage.ts";
import type { BufferProvider } from "../uploads/bufferProvider.ts";
import { LineRecords, outlineGeometry } from "../lines/wideLineGeometry.ts";
import { lineCountOf } from "../lines/wideLines.ts";
import type { BatchedDraw, Member, MergedGeometry } from "./batch.ts";
import { GrowingArray } from "../attributes/growingArray.ts";

/** In one draw: they go to the GPU together whenever one comes or goes. */
const maxLines = 65536;

export class MergedLines implements MergedGeometry {
  readonly #buffers: BufferProvider;
  readonly #records: LineRecords;
  readonly #places = new GrowingArray(Uint32Array);
  readonly #members = new Set<Member>();
  #isWasteful = false;

  /** For draws that are like this one in all that `layoutOf` says. */
  constructor({ stage }: BatchedDraw, buffers: BufferProvider) {
    this.#buffers = buffers;
    this.#records = new LineRecords(stage as BufferStage);
  }

  get members(): Iterable<Member> {
    return this.#members;
  }

  get isEmpty(): boolean {
    return this.#members.size === 0;
  }

  /** Whatever is left of one that is gone would be seen. */
  get needsRebuild(): boolean {
    return this.#isWasteful;
  }

  hasRoomFor({ draw: { ranges } }: Member): boolean {
    return this.#places.length + ranges.reduce((sum, range) => sum + lineCountOf(range), 0) <= maxLines;
  }

  add(member: Member): void {
    const { ranges, stage } = member.draw;
    for (const range of ranges) {
      this.#records.add(stage as BufferStage, range, this.#buffers);
      this.#places.extend(lineCountOf(range)).fill(member.instanceIndex);
    }
    this.#members.add(member);
  }

  remove(member: Member): void {
    this.#members.delete(member);
    this.#isWasteful = true;
  }

  rebuild(): void {
    this.#isWasteful = false;
    this.#records.clear();
    this.#places.clear();
    for (const member of this.#members) this.add(member);
  }

  makeGeometry(): BufferGeometry {
    const geometry = outlineGeometry(this.#places.length);
    this.#records.setOn(geometry);
    geometry.setAttribute("instanceIndex", new InstancedBufferAttribute(this.#places.used, 1));
    return geometry;
  }
}
