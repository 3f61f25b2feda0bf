// Sums of triangle normals, in 32 wrapping bits, from which positions and normals are predicted:
// docs/formats/compact.md, the end of "Positions".

/** `count` sums: x, y, z of each. Edges are shortened by `shift` bits before their cross product. */
export class NormalSums {
  readonly sums: Int32Array;
  readonly #coordinates: Int32Array;
  readonly #shift: number;
  readonly #isUniform: boolean;

  constructor(count: number, coordinates: Int32Array, shift: number, isUniform: boolean) {
    this.sums = new Int32Array(3 * count);
    this.#coordinates = coordinates;
    this.#shift = shift;
    this.#isUniform = isUniform;
  }

  /** Adds the normal of the triangle of vertices va, vb, vc to the sums a, b, c. */
  add(va: number, vb: number, vc: number, a: number, b: number, c: number): void {
    const coordinates = this.#coordinates;
    const shift = this.#shift;
    const x = coordinates[3 * va]!;
    const y = coordinates[3 * va + 1]!;
    const z = coordinates[3 * va + 2]!;
    const ex = (coordinates[3 * vb]! - x) >> shift;
    const ey = (coordinates[3 * vb + 1]! - y) >> shift;
    const ez = (coordinates[3 * vb + 2]! - z) >> shift;
    const fx = (coordinates[3 * vc]! - x) >> shift;
    const fy = (coordinates[3 * vc + 1]! - y) >> shift;
    const fz = (coordinates[3 * vc + 2]! - z) >> shift;
    let nx = (Math.imul(ey, fz) - Math.imul(ez, fy)) | 0;
    let ny = (Math.imul(ez, fx) - Math.imul(ex, fz)) | 0;
    let nz = (Math.imul(ex, fy) - Math.imul(ey, fx)) | 0;
    if (this.#isUniform) {
      const length = Math.abs(nx) + Math.abs(ny) + Math.abs(nz);
      if (length === 0) return;
      nx = Math.trunc((4096 * nx) / length);
      ny = Math.trunc((4096 * ny) / length);
      nz = Math.trunc((4096 * nz) / length);
    }
    this.#addTo(a, nx, ny, nz);
    this.#addTo(b, nx, ny, nz);
    this.#addTo(c, nx, ny, nz);
  }

  #addTo(index: number, nx: number, ny: number, nz: number): void {
    const sums = this.sums;
    sums[3 * index] = sums[3 * index]! + nx;
    sums[3 * index + 1] = sums[3 * index + 1]! + ny;
    sums[3 * index + 2] = sums[3 * index + 2]! + nz;
  }
}

/** The axis of the largest component, the first of equals; 2 where all are 0. */
export function dominantAxis(x: number, y: number, z: number): 0 | 1 | 2 {
  const ax = Math.abs(x);
  const ay = Math.abs(y);
  const az = Math.abs(z);
  if (ax === 0 && ay === 0) return 2;
  return ax >= ay && ax >= az ? 0 : ay >= az ? 1 : 2;
}
