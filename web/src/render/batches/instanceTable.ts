// A float texture with one record per instance in batches (layout: shaders/instanceRecord.ts).
// Draws refer to a record by its index, so that moving, hiding or colouring an instance changes its
// record only.

import { DataTexture, FloatType, RGBAFormat } from "three";
import { texelsPerInstance } from "../shaders/instanceRecord.ts";

const instancesPerRow = 128;
const numbersPerInstance = 4 * texelsPerInstance;
const numbersPerRow = numbersPerInstance * instancesPerRow;
const minRows = 8;

export class InstanceTable {
  /** The uniform of all materials that read it. */
  readonly uniform: { value: DataTexture };
  #numbers = new Float32Array(numbersPerRow * minRows);
  readonly #free: number[] = [];
  /** All indices from here on are free. */
  #end = 0;
  /** The number of indices in use. */
  #used = 0;
  readonly #changedRows = new Set<number>();
  /** One of them, so that not each record of a row is looked up. */
  #lastChangedRow: number | undefined;
  /** The last texture that three.js has uploaded. */
  #uploaded: DataTexture | undefined;

  constructor() {
    this.uniform = { value: this.#newTexture() };
  }

  allocate(): number {
    this.#used += 1;
    const instanceIndex = this.#free.pop() ?? this.#end++;
    if ((instanceIndex + 1) * numbersPerInstance > this.#numbers.length) this.#grow();
    return instanceIndex;
  }

  release(instanceIndex: number): void {
    this.#used -= 1;
    this.#free.push(instanceIndex);
    if (this.#used > 0) return;
    // No record is in use, so the table starts over, with a new texture: the old one may be lost with its context.
    this.#free.length = 0;
    this.#end = 0;
    this.#replace();
  }

  /** All records. Valid until the next `allocate` or `release`. */
  get numbers(): Float32Array {
    return this.#numbers;
  }

  /** The first index in `numbers` of a record that the caller changes: it is uploaded with the next frame. */
  change(instanceIndex: number): number {
    const row = Math.floor(instanceIndex / instancesPerRow);
    if (row !== this.#lastChangedRow) {
      this.#changedRows.add(row);
      this.#lastChangedRow = row;
    }
    return instanceIndex * numbersPerInstance;
  }

  /** Writes `numbers` into the record of an instance from float `first` on. */
  write(instanceIndex: number, first: number, numbers: ArrayLike<number>): void {
    this.#numbers.set(numbers, this.change(instanceIndex) + first);
  }

  /** Call before a frame: changed rows are uploaded with it. */
  update(): void {
    if (this.#changedRows.size === 0) return;
    const texture = this.uniform.value;
    // A new texture is uploaded as a whole.
    if (this.#uploaded === texture)
      for (const row of this.#changedRows) texture.addUpdateRange(row * numbersPerRow, numbersPerRow);
    texture.needsUpdate = true;
    this.#forgetChanges();
  }

  dispose(): void {
    this.uniform.value.dispose();
  }

  #grow(): void {
    const numbers = new Float32Array(2 * this.#numbers.length);
    numbers.set(this.#numbers);
    this.#numbers = numbers;
    this.#replace();
  }

  #replace(): void {
    this.uniform.value.dispose();
    this.uniform.value = this.#newTexture();
    this.#forgetChanges();
  }

  #forgetChanges(): void {
    this.#changedRows.clear();
    this.#lastChangedRow = undefined;
  }

  /** three.js uploads it as a whole. */
  #newTexture(): DataTexture {
    const texture = new DataTexture(
      this.#numbers,
      instancesPerRow * texelsPerInstance,
      this.#numbers.length / numbersPerRow,
      RGBAFormat,
      FloatType,
    );
    texture.needsUpdate = true;
    texture.onUpdate = () => {
      this.#uploaded = texture;
    };
    return texture;
  }
}
