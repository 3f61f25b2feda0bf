// Collects the attributes that move the vertices of a patch. Its stages wait for all of them: without, its vertices would
// be where they were modelled.

import type { GeometryDescription } from "../document/description.ts";
import { DecodeError } from "../decode/decodeError.ts";
import type { Deformation, StoredNumbers } from "../stage/deformation.ts";
import { deformationOf } from "../stage/deformation.ts";

export class DeformationCollector {
  readonly #geometry: GeometryDescription;
  #attributes: (StoredNumbers | undefined)[] = [];
  #deformation: Deformation | undefined;

  constructor(geometry: GeometryDescription) {
    this.#geometry = geometry;
  }

  /** Undefined for a geometry whose vertices do not move, or while attributes are missing. */
  get deformation(): Deformation | undefined {
    return this.#deformation;
  }

  /** Whether nothing is missing. */
  get isWhole(): boolean {
    return this.#geometry.deformation === undefined || this.#deformation !== undefined;
  }

  /** Bytes of the texels, as many of which are on the GPU. */
  get byteLength(): number {
    return this.#deformation?.texels.byteLength ?? 0;
  }

  /** Adds attribute `n` of the geometry's deformation, of `vertexCount` vertices. Throws DecodeError if it is too short. */
  add(n: number, numbers: StoredNumbers, vertexCount: number): void {
    const { deformation } = this.#geometry;
    if (deformation === undefined) return;
    const { array, stride, offset, components } = numbers.vertices;
    if (vertexCount > 0 && (vertexCount - 1) * stride + offset + components > array.length)
      throw new DecodeError("truncated", `holds fewer than ${vertexCount} vertices`);
    this.#attributes[n] = numbers;
    const all = deformation.attributes.flatMap((_, i) => this.#attributes[i] ?? []);
    if (all.length < deformation.attributes.length) return;
    this.#deformation = deformationOf(deformation.layout, all, vertexCount);
    this.#attributes = [];
  }

  clear(): void {
    this.#attributes = [];
    this.#deformation = undefined;
  }
}
