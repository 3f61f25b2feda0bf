// Decodes vertex positions. The encoder chose one of several parallelograms to predict each position from; the last
// coordinate is predicted from the plane of the surface decoded so far: docs/formats/compact.md, "Positions".

import { DecodeError } from "../decodeError.ts";
import type { Connectivity } from "./connectivity.ts";
import { after, before } from "./connectivity.ts";
import type { Version } from "./header.ts";
import type { Segments } from "./segments.ts";
import { dominantAxis, NormalSums } from "./normalSums.ts";
import type { RangeDecoder } from "./rangeDecoder.ts";
import { bitLength, numberModelCount } from "./rangeDecoder.ts";
import type { Grid, PatchHeader } from "./sizes.ts";

/** The first model of each symbol in the stream. */
interface PositionModels {
  /** `choicesOfSet` for each set and agreement of candidates. */
  readonly choice: number;
  readonly choicesOfSet: number;
  // Residuals off the grid, in the order of coding, and of a coordinate that is alone off the grid.
  readonly first: number;
  readonly second: number;
  readonly third: number;
  readonly lone: number;
  // Patches with a grid only:
  readonly line: number;
  readonly mask: number;
  /** Version 2: the bit after the first of residuals; `numberModelCount` for each of first, second, third and lone. */
  readonly nextBit: number;
  readonly count: number;
}

export function positionModelsOf(version: Version): PositionModels {
  const isOld = version === 1;
  const choicesOfSet = isOld ? 4 : 8;
  const first = (isOld ? 8 : 32) * 16 * choicesOfSet;
  const second = first + (isOld ? 16 : 24) * numberModelCount;
  const third = second + 31 * numberModelCount;
  const lone = third + 31 * numberModelCount;
  const line = lone + 8 * numberModelCount;
  const mask = line + 96 * numberModelCount;
  const nextBit = mask + 512 * 8;
  const count = nextBit + (isOld ? 0 : 4 * numberModelCount);
  return { choice: 0, choicesOfSet, first, second, third, lone, line, mask, nextBit, count };
}

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
  readonly #isOld: boolean;
  readonly #models: PositionModels;
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
  /** Version 2, per vertex: the size of its residuals off the grid, at most 2^24. */
  readonly #sizes: Int32Array;
  /** x, y, z of each candidate. */
  readonly #candidates = new Int32Array(3 * 9);
  #candidateCount = 0;
  #candidateSet = 0;
  /** Context: 1 + the bit length of the distance of the first two candidates, at most 15; 0 for a single candidate. */
  #agreement = 0;
  /** The chosen candidate, and the normal of the surface there, of any length. */
  readonly #guess = new Int32Array(3);
  readonly #normal = new Int32Array(3);

  constructor(decoder: RangeDecoder, header: PatchHeader, connectivity: Connectivity, segments: Segments | undefined) {
    const { version, vertexCount, positionBits, grid } = header;
    this.#decoder = decoder;
    this.#isOld = version === 1;
    this.#models = positionModelsOf(version);
    this.#sizes = new Int32Array(this.#isOld ? 0 : vertexCount);
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
    this.#decode(x, 2, 0, this.#sizeBefore(x));
  }

  /** Three times the size of the residuals of the vertex before. */
  #sizeBefore(x: number): number {
    return this.#isOld || x === 0 ? 0 : 3 * this.#sizes[x - 1]!;
  }

  /** Decodes a vertex of a line from the lines that lead to it. */
  #decodeOnLine(x: number, from: Int32Array): void {
    const last = from[x]!;
    const further = from[last]!;
    this.#beginCandidates(last, last, last);
    if (further >= 0) this.#addCandidate(last, last, further, 1);
    this.#normal.fill(0);
    this.#decode(x, 2, 0, this.#sizeBefore(x));
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
    const sizes = this.#sizes;
    if (!this.#isOld) this.#addSecondRing(across, o);
    const dominant = this.#setNormal(k, p);
    const masks = this.#masks;
    this.#decode(
      x,
      dominant,
      this.#grid ? masks[k]! * 64 + masks[p]! * 8 + masks[o]! : 0,
      this.#isOld ? 0 : sizes[o]! + sizes[p]! + sizes[k]!,
    );
  }

  /**
   * Adds points beyond the ends of the edge, seen from the neighbours of the triangle behind it, and the middles of the
   * first three parallelograms. `o` is the vertex of the corner `across`.
   */
  #addSecondRing(across: number, o: number): void {
    const { vertex, across: acrosses, closing } = this.#connectivity;
    const parallelograms = this.#candidateCount;
    const i = across % 3;
    const t = (across - i) / 3;
    const first = acrosses[t]!;
    if (first >= 0 && i < 2) {
      const end = vertex[3 * t + 1 - i]!;
      this.#addCandidate(end, end, vertex[first]!, 8);
    }
    const s = closing[t]!;
    if (s >= 0) {
      const a = vertex[after(s)]!;
      const b = vertex[before(s)]!;
      if (a === o) this.#addCandidate(b, b, vertex[s]!, 16);
      else if (b === o) this.#addCandidate(a, a, vertex[s]!, 16);
    }
    if (parallelograms > 1) this.#addMiddle(0, 1);
    if (parallelograms > 2) {
      this.#addMiddle(0, 2);
      this.#addMiddle(1, 2);
    }
  }

  /** Adds the middle of two candidates, rounded down. */
  #addMiddle(a: number, b: number): void {
    const candidates = this.#candidates;
    const first = 3 * this.#candidateCount++;
    for (let axis = 0; axis < 3; ++axis)
      candidates[first + axis] = Math.floor((candidates[3 * a + axis]! + candidates[3 * b + axis]!) / 2);
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
      const { choice, choicesOfSet } = this.#models;
      const models = choice + (this.#candidateSet * 16 + this.#agreement) * choicesOfSet;
      while (chosen < last && decoder.bit(models + chosen) === 0) ++chosen;
    }
    guess[0] = candidates[3 * chosen]!;
    guess[1] = candidates[3 * chosen + 1]!;
    guess[2] = candidates[3 * chosen + 2]!;
  }

  /**
   * Reads the residuals of a vertex, with the candidates and the normal that were set. `sizeAround` is the size of the
   * residuals of three vertices before it.
   */
  #decode(x: number, dominant: 0 | 1 | 2, maskContext: number, sizeAround: number): void {
    const decoder = this.#decoder;
    const coordinates = this.#coordinates;
    const guess = this.#guess;
    const grid = this.#grid;
    const isOld = this.#isOld;
    const positionModels = this.#models;
    const step = this.#isExact?.[x] === 0 ? this.#residualStep : 1;
    let mask = 0;
    if (grid) this.#masks[x] = mask = decoder.tree(positionModels.mask + 8 * maskContext, 3);
    this.#choose();
    const firstContext = isOld ? this.#agreement : (this.#agreement + sizeContext(sizeAround)) >> 1;
    let steps = 0;
    let size = 0;
    let maxLength = 0;
    let length = -1; // bit length of the previous residual off the grid
    for (let j = 0; j < 3; ++j) {
      const axis = orders[3 * (3 * mask + dominant) + j]!;
      let value: number;
      if (grid && (mask & (1 << axis)) !== 0) {
        const residual = decoder.small(
          positionModels.line + numberModelCount * ((j * 4 + Math.min(steps, 3)) * 8 + (this.#agreement >> 1)),
        );
        steps += Math.abs(residual);
        value = planeCoordinate(grid, axis, nearestPlane(grid, axis, this.#clamp(guess[axis]!)) + residual);
      } else {
        const expected = j === 2 ? this.#height(x, dominant, mask, axis) : guess[axis]!;
        let kind: number;
        let models: number;
        if (length < 0) {
          kind = j === 2 ? 3 : 0;
          models =
            j === 2
              ? positionModels.lone + numberModelCount * Math.min(steps, 7)
              : positionModels.first + numberModelCount * firstContext;
        } else if (j === 2 && mask === 0) {
          kind = 2;
          models = positionModels.third + numberModelCount * maxLength;
        } else {
          kind = 1;
          models = positionModels.second + numberModelCount * length;
        }
        const residual = isOld
          ? decoder.signed(models)
          : decoder.longSigned(models, positionModels.nextBit + numberModelCount * kind);
        size += Math.abs(residual);
        length = bitLength(Math.abs(residual));
        maxLength = Math.max(maxLength, length);
        value = this.#clamp(expected) + residual * step;
      }
      if (value < 0 || value > this.#maxCoordinate)
        throw new DecodeError("malformed", "holds a vertex outside of its lattice");
      coordinates[3 * x + axis] = value;
    }
    if (!isOld) this.#sizes[x] = Math.min(size, 2 ** 24);
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

/** A size in half bits, 0 … 31. */
function sizeContext(size: number): number {
  const length = bitLength(size);
  return length < 2 ? length : Math.min(31, 2 * (length - 1) + ((size >> (length - 2)) & 1));
}

/** The coordinate of the grid's plane i along an axis. */
function planeCoordinate({ origin, step }: Grid, axis: number, i: number): number {
  return Math.floor((origin[axis]! + i * step[axis]! + 32768) / 65536);
}

/** The index of the grid's plane that is nearest to a coordinate. */
function nearestPlane({ origin, step }: Grid, axis: number, coordinate: number): number {
  return Math.floor((65536 * coordinate - origin[axis]! + Math.trunc(step[axis]! / 2)) / step[axis]!);
}
