// Normals of faces whose document gives none, by the crease angle. The faces stay the same while their positions may
// change, in every frame: so they are prepared once, and computing allocates nothing.

/** Each face around a position is compared with each other one: C++ has the same limit (src/import/x3d/faces.h). */
export const maxComparedFaces = 1024;

export class CreasedNormals {
  /** For each corner of each face: x, y and z of a unit normal. Replaced by `compute`. */
  readonly normals: Float64Array;
  /** The position of each corner, face by face. */
  readonly #positions: Uint32Array;
  /** The first corner of each face, and the number of corners. */
  readonly #firstCorners: Uint32Array;
  /** The number of the position of each corner, among those that are used. */
  readonly #numbers: Uint32Array;
  /** Where the faces around each position begin in `#around`, and its length. */
  readonly #firstAround: Uint32Array;
  /** The faces around the positions, in the order of faces. */
  readonly #around: Uint32Array;
  readonly #faceNormals: Float64Array;
  /** The sum of the face normals around each position that is used; undefined where creases divide them. */
  readonly #sums: Float64Array | undefined;
  readonly #minCosine: number;
  readonly creaseAngle: number;

  /** `faces`: the positions of their corners. `creaseAngle` in radians. */
  constructor(faces: readonly (readonly number[])[], creaseAngle: number) {
    this.creaseAngle = creaseAngle;
    this.#positions = Uint32Array.from(faces.flat());
    this.normals = new Float64Array(3 * this.#positions.length);
    this.#minCosine = Math.cos(Math.min(creaseAngle, Math.PI)) - 1e-9;
    this.#faceNormals = new Float64Array(3 * faces.length);
    this.#firstCorners = firstsOf(faces.map((face) => face.length));
    const numbers = new Map<number, number>();
    this.#numbers = this.#positions.map((position) => {
      const number = numbers.get(position) ?? numbers.size;
      numbers.set(position, number);
      return number;
    });
    const counts = new Array<number>(numbers.size).fill(0);
    for (const number of this.#numbers) counts[number] = (counts[number] ?? 0) + 1;
    this.#firstAround = firstsOf(counts);
    this.#around = this.#facesAround(faces.length);
    this.#sums = creaseAngle < Math.PI ? undefined : new Float64Array(3 * numbers.size);
  }

  /**
   * Each corner gets the mean of the unit normals of those faces around its position whose normal deviates from its own
   * face's by at most the crease angle; where more than `maxComparedFaces` meet, that of its own face, unless the angle
   * is π or more. A face without area adds nothing to the mean; a mean without direction becomes +z. `positions`: x, y
   * and z of each.
   */
  compute(positions: ArrayLike<number>): Float64Array {
    const faceCount = this.#firstCorners.length - 1;
    for (let face = 0; face < faceCount; ++face) this.#computeFaceNormal(face, positions);
    if (this.#sums) this.#computeSmooth(this.#sums);
    else this.#computeCreased();
    return this.normals;
  }

  /** The normals of corners at one position are equal. */
  #computeSmooth(sums: Float64Array): void {
    const [firsts, numbers, faceNormals, normals] = [
      this.#firstCorners,
      this.#numbers,
      this.#faceNormals,
      this.normals,
    ];
    sums.fill(0);
    for (let face = 0; face < firsts.length - 1; ++face)
      for (let corner = firsts[face] ?? 0; corner < (firsts[face + 1] ?? 0); ++corner) {
        const at = 3 * (numbers[corner] ?? 0);
        for (let c = 0; c < 3; ++c) sums[at + c] = (sums[at + c] ?? 0) + (faceNormals[3 * face + c] ?? 0);
      }
    for (let at = 0; at < sums.length; at += 3) makeUnit(sums, at);
    for (let corner = 0; corner < numbers.length; ++corner) {
      const at = 3 * (numbers[corner] ?? 0);
      for (let c = 0; c < 3; ++c) normals[3 * corner + c] = sums[at + c] ?? 0;
    }
  }

  #computeCreased(): void {
    const firsts = this.#firstCorners;
    for (let face = 0; face < firsts.length - 1; ++face)
      for (let corner = firsts[face] ?? 0; corner < (firsts[face + 1] ?? 0); ++corner) {
        this.#sumAround(corner, face);
        makeUnit(this.normals, 3 * corner);
      }
  }

  #facesAround(faceCount: number): Uint32Array {
    const around = new Uint32Array(this.#positions.length);
    const next = this.#firstAround.slice();
    for (let face = 0; face < faceCount; ++face)
      for (let corner = this.#firstCorners[face] ?? 0; corner < (this.#firstCorners[face + 1] ?? 0); ++corner) {
        const number = this.#numbers[corner] ?? 0;
        const at = next[number] ?? 0;
        around[at] = face;
        next[number] = at + 1;
      }
    return around;
  }

  /**
   * The unit normal by Newell's method; zero for a face without area. Positions count from the first corner: far from
   * the origin, products of coordinates themselves would have no digits left for the face.
   */
  #computeFaceNormal(face: number, positions: ArrayLike<number>): void {
    const begin = this.#firstCorners[face] ?? 0;
    const end = this.#firstCorners[face + 1] ?? begin;
    const first = 3 * (this.#positions[begin] ?? 0);
    const [x0, y0, z0] = [positions[first] ?? 0, positions[first + 1] ?? 0, positions[first + 2] ?? 0];
    let [x, y, z, beforeX, beforeY, beforeZ] = [0, 0, 0, 0, 0, 0];
    for (let corner = begin + 1; corner < end; ++corner) {
      const at = 3 * (this.#positions[corner] ?? 0);
      const afterX = (positions[at] ?? 0) - x0;
      const afterY = (positions[at + 1] ?? 0) - y0;
      const afterZ = (positions[at + 2] ?? 0) - z0;
      x += beforeY * afterZ - beforeZ * afterY;
      y += beforeZ * afterX - beforeX * afterZ;
      z += beforeX * afterY - beforeY * afterX;
      [beforeX, beforeY, beforeZ] = [afterX, afterY, afterZ];
    }
    const normals = this.#faceNormals;
    [normals[3 * face], normals[3 * face + 1], normals[3 * face + 2]] = [x, y, z];
    const length = lengthOf(normals, 3 * face);
    const scale = length > 0 && length < Infinity ? length : Infinity;
    for (let c = 0; c < 3; ++c) normals[3 * face + c] = (normals[3 * face + c] ?? 0) / scale || 0;
  }

  /** Writes the sum of the normals around a corner of a face. */
  #sumAround(corner: number, face: number): void {
    const normals = this.#faceNormals;
    const number = this.#numbers[corner] ?? 0;
    const [ownX, ownY, ownZ] = [normals[3 * face] ?? 0, normals[3 * face + 1] ?? 0, normals[3 * face + 2] ?? 0];
    const begin = this.#firstAround[number] ?? 0;
    const end = this.#firstAround[number + 1] ?? 0;
    const areCompared = end - begin <= maxComparedFaces;
    let [x, y, z] = areCompared ? [0, 0, 0] : [ownX, ownY, ownZ];
    for (let i = begin; areCompared && i < end; ++i) {
      const other = this.#around[i] ?? 0;
      const [otherX, otherY, otherZ] = [
        normals[3 * other] ?? 0,
        normals[3 * other + 1] ?? 0,
        normals[3 * other + 2] ?? 0,
      ];
      if (other !== face && ownX * otherX + ownY * otherY + ownZ * otherZ < this.#minCosine) continue;
      x += otherX;
      y += otherY;
      z += otherZ;
    }
    [this.normals[3 * corner], this.normals[3 * corner + 1], this.normals[3 * corner + 2]] = [x, y, z];
  }
}

/** Where each of consecutive runs of these lengths begins, and where the last one ends. */
function firstsOf(lengths: readonly number[]): Uint32Array {
  const firsts = new Uint32Array(lengths.length + 1);
  lengths.forEach((length, i) => {
    firsts[i + 1] = (firsts[i] ?? 0) + length;
  });
  return firsts;
}

/** Divides a vector by its length; one without direction becomes +z. */
function makeUnit(vectors: Float64Array, at: number): void {
  const length = lengthOf(vectors, at);
  const hasDirection = length > 0 && length < Infinity;
  for (let c = 0; c < 3; ++c) vectors[at + c] = hasDirection ? (vectors[at + c] ?? 0) / length : Number(c === 2);
}

function lengthOf(vectors: Float64Array, at: number): number {
  const [x, y, z] = [vectors[at] ?? 0, vectors[at + 1] ?? 0, vectors[at + 2] ?? 0];
  const length = Math.sqrt(x * x + y * y + z * z);
  return length > 1e-150 && length < 1e150 ? length : Math.hypot(x, y, z); // slower, but squares do not overflow
}
