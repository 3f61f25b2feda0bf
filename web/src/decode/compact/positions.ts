// Decodes vertex positions. The encoder chose one of several parallelograms to predict each position from; the last
// coordinate is predicted from the plane of the surface decoded so far: docs/formats/compact.md, "Positions".

import { DecodeError } from "../decodeError.ts";
import type { Connectivity } from "./connectivity.ts";
import { after, before } from "./connectivity.ts";
import type { Segments } from "./segments.ts";
import { dominantAxis, NormalSums } from "./normalSums.ts";
import type { RangeDecoder } from "./rangeDecoder.ts";
import { bitLength, numberModelCount } from "./rangeDecoder.ts";
import type { Grid, PatchHeader } from "./sizes.ts";

const choiceModels = 0;
const firstModels = choiceModels + 8 * 16 * 4;
const secondModels = firstModels + 16 * numberModelCount;
const thirdModels = secondModels + 31 * numberModelCount;
// Patches with a grid only:
const loneModels = thirdModels + 31 * numberModelCount;
const gridModels = loneModels + 8 * numberModelCount;
const maskModels = gridModels + 96 * numberModelCount;
export const positionModelCount = maskModels + 512 * 8;

export interface Positions {
  /** x, y, z of each vertex, then those of the middle of the lattice. */
  readonly coordinates: Int32Array;
  /** x, y, z of the sum of the triangle normals around each vertex; 0 in points and lines. */
  readonly normalSums: Int32Array;
}

/** Safe for untrusted bytes. Throws DecodeError. */
export function decodePositions(
  decoder: RangeDecoder,
  header: PatchHeader,
  connectivity: Connectivity,
  segments: Segments | undefined,
): Positions {
  return new PositionDecoder(decoder, header, connectivity, segments).run();
}

/** The order in which coordinates are decoded: element 3 (3 mask + dominant axis) + j is the j-th axis. */
const orders = Uint8Array.from({ length: 8 }, (_, mask) => mask).reduce<number[]>((all, mask) => {
  for (const dominant of [0, 1, 2]) {
    const onGrid = [0, 1, 2].filter((axis) => (mask & (1 << axis)) !== 0);
    const offGrid = [1, 2, 3].map((step) => (dominant + step) % 3).filter((axis) => (mask & (1 << axis)) === 0);
    all.push(...onGrid, ...offGrid);
  }
  return all;
}, []);

class PositionDecoder {
  readonly #decoder: RangeDecoder;
  readonly #connectivity: Connectivity;
  readonly #vertexCount: number;
  readonly #maxCoordinate: number;
  readonly #grid: Grid | undefined;
  readonly #masks: Uint8Array;
  /**
   * Base meshes only, per vertex: 1 where residuals are in lattice steps, 0 where they are in multiples of
   * `#residualStep`.
   */
  readonly #isExact: Uint8Array | undefined;
  readonly #residualStep: number;
  /** x, y, z of each vertex; then the middle of the lattice, from which the first vertex is predicted. */
  readonly #coordinates: Int32Array;
  readonly #sums: NormalSums;
  /** x, y, z of each candidate. */
  readonly #candidates = new Int32Array(3 * 4);
  #candidateCount = 0;
  #candidateSet = 0;
  /** Context: 1 + the bit length of the distance of the first two candidates, at most 15; 0 for a single candidate. */
  #agreement = 0;
  /** The chosen candidate, and the normal of the surface there, of any length. */
  readonly #guess = new Int32Array(3);
  readonly #normal = new Int32Array(3);

  constructor(decoder: RangeDecoder, header: PatchHeader, connectivity: Connectivity, segments: Segments | undefined) {
    const { vertexCount, positionBits, grid } = header;
    this.#decoder = decoder;
    this.#connectivity = connectivity;
    this.#vertexCount = vertexCount;
    this.#maxCoordinate = 2 ** positionBits - 1;
    this.#grid = grid;
    this.#masks = new Uint8Array(grid ? vertexCount : 0);
    this.#isExact = segments?.isShared;
    this.#residualStep = 2 ** header.residualShift;
    this.#coordinates = new Int32Array(3 * (vertexCount + 1));
    this.#coordinates.fill(2 ** (positionBits - 1), 3 * vertexCount);
    this.#sums = new NormalSums(
      header.topology === "triangles" ? vertexCount : 0,
      this.#coordinates,
      header.normalShift,
      false,
    );
  }

  run(): Positions {
    const { vertex, across, from } = this.#connectivity;
    const sums = this.#sums;
    let next = 0;
    for (let t = 0; t < across.length; ++t) {
      const c = 3 * t;
      if (vertex[c] === next) this.#decodeFromPrevious(next++);
      if (vertex[c + 1] === next) this.#decodeFromPrevious(next++);
      if (vertex[c + 2] === next) this.#decodeAcrossEdge(next++, across[t]!);
      const va = vertex[c]!;
      const vb = vertex[c + 1]!;
      const vc = vertex[c + 2]!;
      sums.add(va, vb, vc, va, vb, vc);
    }
    for (; next < this.#vertexCount; ++next) {
      // points and lines
      if (from.length > 0 && from[next]! >= 0) this.#decodeOnLine(next, from);
      else this.#decodeFromPrevious(next);
    }
    return { coordinates: this.#coordinates, normalSums: sums.sums };
  }

  /** Decodes a vertex from the vertex before it in the order of decoding. */
  #decodeFromPrevious(x: number): void {
    const last = x > 0 ? x - 1 : this.#vertexCount;
    this.#beginCandidates(last, last, last);
    this.#normal.fill(0);
    this.#decode(x, 2, 0);
  }

  /** Decodes a vertex of a line from the lines that lead to it. */
  #decodeOnLine(x: number, from: Int32Array): void {
    const last = from[x]!;
    const further = from[last]!;
    this.#beginCandidates(last, last, last);
    if (further >= 0) this.#addCandidate(last, last, further, 1);
    this.#normal.fill(0);
    this.#decode(x, 2, 0);
  }

  /**
   * Decodes the third vertex of a triangle; `across` is the corner opposite its first edge in the neighbour there, or
   * -1 for a root.
   */
  #decodeAcrossEdge(x: number, across: number): void {
    if (across < 0) {
      this.#decodeFromPrevious(x);
      return;
    }
    const { vertex, ahead, behind, second } = this.#connectivity;
    const o = vertex[across]!;
    const p = vertex[after(across)]!;
    const k = vertex[before(across)]!;
    this.#beginCandidates(k, p, o);
    const s = second[x]!;
    if (s >= 0) this.#addCandidate(vertex[after(s)]!, vertex[before(s)]!, vertex[s]!, 1);
    if (ahead[x]! >= 0) this.#addCandidate(p, ahead[x]!, k, 2);
    if (behind[x]! >= 0) this.#addCandidate(p, p, behind[x]!, 4);
    const dominant = this.#setNormal(k, p);
    const masks = this.#masks;
    this.#decode(x, dominant, this.#grid ? masks[k]! * 64 + masks[p]! * 8 + masks[o]! : 0);
  }

  #beginCandidates(a: number, b: number, c: number): void {
    this.#candidateCount = 0;
    this.#candidateSet = 0;
    this.#addCandidate(a, b, c, 0);
  }

  /** Adds the parallelogram a + b - c. */
  #addCandidate(a: number, b: number, c: number, flag: number): void {
    const coordinates = this.#coordinates;
    const candidates = this.#candidates;
    const first = 3 * this.#candidateCount++;
    candidates[first] = coordinates[3 * a]! + coordinates[3 * b]! - coordinates[3 * c]!;
    candidates[first + 1] = coordinates[3 * a + 1]! + coordinates[3 * b + 1]! - coordinates[3 * c + 1]!;
    candidates[first + 2] = coordinates[3 * a + 2]! + coordinates[3 * b + 2]! - coordinates[3 * c + 2]!;
    this.#candidateSet += flag;
  }

  /**
   * Sets the surface's normal at an edge, shortened to 15 bits so that products are exact; returns its dominant axis.
   */
  #setNormal(k: number, p: number): 0 | 1 | 2 {
    const sums = this.#sums.sums;
    const normal = this.#normal;
    const x = (sums[3 * k]! + sums[3 * p]!) | 0;
    const y = (sums[3 * k + 1]! + sums[3 * p + 1]!) | 0;
    const z = (sums[3 * k + 2]! + sums[3 * p + 2]!) | 0;
    const shift = Math.max(0, bitLength(Math.max(Math.abs(x), Math.abs(y), Math.abs(z))) - 15);
    normal[0] = x >> shift;
    normal[1] = y >> shift;
    normal[2] = z >> shift;
    return dominantAxis(x, y, z);
  }

  /** Reads which candidate the encoder chose, and makes it the guess. */
  #choose(): void {
    const decoder = this.#decoder;
    const candidates = this.#candidates;
    const guess = this.#guess;
    const last = this.#candidateCount - 1;
    this.#agreement = 0;
    let chosen = 0;
    if (last > 0) {
      const apart = Math.max(
        Math.abs(candidates[3]! - candidates[0]!),
        Math.abs(candidates[4]! - candidates[1]!),
        Math.abs(candidates[5]! - candidates[2]!),
      );
      this.#agreement = 1 + Math.min(14, bitLength(apart));
      const models = choiceModels + (this.#candidateSet * 16 + this.#agreement) * 4;
      while (chosen < last && decoder.bit(models + chosen) === 0) ++chosen;
    }
    guess[0] = candidates[3 * chosen]!;
    guess[1] = candidates[3 * chosen + 1]!;
    guess[2] = candidates[3 * chosen + 2]!;
  }

  /** Reads the residuals of a vertex, with the candidates and the normal that were set. */
  #decode(x: number, dominant: 0 | 1 | 2, maskContext: number): void {
    const decoder = this.#decoder;
    const coordinates = this.#coordinates;
    const guess = this.#guess;
    const grid = this.#grid;
    const step = this.#isExact?.[x] === 0 ? this.#residualStep : 1;
    let mask = 0;
    if (grid) this.#masks[x] = mask = decoder.tree(maskModels + 8 * maskContext, 3);
    this.#choose();
    let steps = 0;
    let maxLength = 0;
    let length = -1; // bit length of the previous residual off the grid
    for (let j = 0; j < 3; ++j) {
      const axis = orders[3 * (3 * mask + dominant) + j]!;
      let value: number;
      if (grid && (mask & (1 << axis)) !== 0) {
        const residual = decoder.small(
          gridModels + numberModelCount * ((j * 4 + Math.min(steps, 3)) * 8 + (this.#agreement >> 1)),
        );
        steps += Math.abs(residual);
        value = planeCoordinate(grid, axis, nearestPlane(grid, axis, this.#clamp(guess[axis]!)) + residual);
      } else {
        const expected = j === 2 ? this.#height(x, dominant, mask, axis) : guess[axis]!;
        const models =
          length < 0
            ? j === 2
              ? loneModels + numberModelCount * Math.min(steps, 7)
              : firstModels + numberModelCount * this.#agreement
            : j === 2 && mask === 0
              ? thirdModels + numberModelCount * maxLength
              : secondModels + numberModelCount * length;
        const residual = decoder.signed(models);
        length = bitLength(Math.abs(residual));
        maxLength = Math.max(maxLength, length);
        value = this.#clamp(expected) + residual * step;
      }
      if (value < 0 || value > this.#maxCoordinate)
        throw new DecodeError("malformed", "holds a vertex outside of its lattice");
      coordinates[3 * x + axis] = value;
    }
  }

  /** Predicts the last coordinate: that of the surface's plane at the two other coordinates. */
  #height(x: number, dominant: number, mask: number, axis: number): number {
    const normal = this.#normal;
    const guess = this.#guess;
    const coordinates = this.#coordinates;
    if (normal[axis] === 0) return guess[axis]!;
    const u = orders[3 * (3 * mask + dominant)]!;
    const w = orders[3 * (3 * mask + dominant) + 1]!;
    const rise =
      normal[u]! * (coordinates[3 * x + u]! - guess[u]!) + normal[w]! * (coordinates[3 * x + w]! - guess[w]!);
    return guess[axis]! - Math.trunc(rise / normal[axis]!);
  }

  #clamp(coordinate: number): number {
    return Math.min(Math.max(coordinate, 0), this.#maxCoordinate);
  }
}

/** The coordinate of the grid's plane i along an axis. */
function planeCoordinate({ origin, step }: Grid, axis: number, i: number): number {
  return Math.floor((origin[axis]! + i * step[axis]! + 32768) / 65536);
}

/** The index of the grid's plane that is nearest to a coordinate. */
function nearestPlane({ origin, step }: Grid, axis: number, coordinate: number): number {
  return Math.floor((65536 * coordinate - origin[axis]! + Math.trunc(step[axis]! / 2)) / step[axis]!);
}
