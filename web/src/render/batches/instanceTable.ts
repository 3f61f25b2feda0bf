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

  /** Writes `numbers` into the record of an instance from float `first` on. Returns whether any has changed. */
  write(instanceIndex: number, first: number, numbers: ArrayLike<number>): boolean {
    const begin = instanceIndex * numbersPerInstance + first;
    let isChanged = false;
    for (let i = 0; i < numbers.length; ++i) {
      const rounded = Math.fround(numbers[i] ?? 0);
      if (this.#numbers[begin + i] === rounded) continue;
      this.#numbers[begin + i] = rounded;
      isChanged = true;
    }
    if (isChanged) this.#changedRows.add(Math.floor(instanceIndex / instancesPerRow));
    return isChanged;
  }

  /**
   * As `write` from float 0 on, for numbers that are of single precision already: this is what a moved instance costs.
   */
  writeRounded(instanceIndex: number, numbers: Float32Array): boolean {
    const all = this.#numbers;
    const begin = instanceIndex * numbersPerInstance;
    let isChanged = false;
    for (let i = 0; i < numbers.length; ++i) {
      const number = numbers[i] ?? 0;
      if (all[begin + i] === number) continue;
      all[begin + i] = number;
      isChanged = true;
    }
    if (isChanged) this.#changedRows.add(Math.floor(instanceIndex / instancesPerRow));
    return isChanged;
  }

  /** Call before a frame: changed rows are uploaded with it. */
  update(): void {
    if (this.#changedRows.size === 0) return;
    const texture = this.uniform.value;
    // A new texture is uploaded as a whole.
    if (this.#uploaded === texture)
      for (const row of this.#changedRows) texture.addUpdateRange(row * numbersPerRow, numbersPerRow);
    texture.needsUpdate = true;
    this.#changedRows.clear();
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
    this.#changedRows.clear();
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
