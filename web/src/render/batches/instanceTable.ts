// What differs from place to place, as texels: a record for each place in which
// something is drawn together with others. Draws carry no more of a place than
// its number, so that moving, hiding or colouring it changes its record alone.

import { DataTexture, FloatType, RGBAFormat } from "three";
import { texelsPerInstance } from "../shaders/instanceRecord.ts";

const instancesPerRow = 128;
const numbersPerInstance = 4 * texelsPerInstance;
const numbersPerRow = numbersPerInstance * instancesPerRow;
const minRows = 8;

export class InstanceTable {
  /** For all materials that read it. */
  readonly uniform: { value: DataTexture };
  #numbers = new Float32Array(numbersPerRow * minRows);
  readonly #free: number[] = [];
  /** Places that have ever been given out, and those that are now. */
  #end = 0;
  #used = 0;
  readonly #changedRows = new Set<number>();
  /** The last texture that three.js has brought to the GPU. */
  #sent: DataTexture | undefined;

  constructor() {
    this.uniform = { value: this.#newTexture() };
  }

  allocate(): number {
    this.#used += 1;
    const place = this.#free.pop() ?? this.#end++;
    if ((place + 1) * numbersPerInstance > this.#numbers.length) this.#grow();
    return place;
  }

  release(place: number): void {
    this.#used -= 1;
    this.#free.push(place);
    if (this.#used > 0) return;
    // Nothing needs it: it begins anew, also where a lost context has taken the texture.
    this.#free.length = 0;
    this.#end = 0;
    this.#replace();
  }

  /** Sets numbers of a place from number `first` of its record on; whether one of them was another. */
  write(place: number, first: number, numbers: readonly number[]): boolean {
    const begin = place * numbersPerInstance + first;
    let isChanged = false;
    for (let i = 0; i < numbers.length; ++i) {
      const rounded = Math.fround(numbers[i] ?? 0);
      if (this.#numbers[begin + i] === rounded) continue;
      this.#numbers[begin + i] = rounded;
      isChanged = true;
    }
    if (isChanged) this.#changedRows.add(Math.floor(place / instancesPerRow));
    return isChanged;
  }

  /** Before a frame: rows that have changed go to the GPU with it. */
  update(): void {
    if (this.#changedRows.size === 0) return;
    const texture = this.uniform.value;
    // What has not been there yet goes as a whole.
    if (this.#sent === texture)
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

  /** Goes to the GPU as a whole. */
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
      this.#sent = texture;
    };
    return texture;
  }
}
