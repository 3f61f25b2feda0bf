// X3D's Extrusion (ISO/IEC 19775-1, 13.3.5): sweeps a cross-section along a spine. src/import/x3d/extrusion.cpp makes
// the same vertices and faces: vectors/tessellation/extrusion.json tests both.

import type { Corner, Surface } from "./faces.ts";
import type { Vec3 } from "./vectors.ts";
import { cross, dot, minus, rotated, unit } from "./vectors.ts";

/** The x, y and z axes of a cross-section's plane, whose normal is y. */
type Frame = readonly [Vec3, Vec3, Vec3];

/**
 * The fields of an Extrusion node: 2D points, points, 2D scales, and rotations (axis and angle), one number after the
 * other.
 */
export interface ExtrusionFields {
  readonly crossSection: readonly number[];
  readonly spine: readonly number[];
  readonly scale: readonly number[];
  readonly orientation: readonly number[];
  readonly beginCap: boolean;
  readonly endCap: boolean;
}

/**
 * Vertices row by row along the spine, quadrilaterals between the rows, then the caps, which have vertices of their
 * own. Undefined if the spine or the cross-section has fewer than two points.
 */
export function extrusion(values: ExtrusionFields): Surface | undefined {
  const spine = vectorsOf(values.spine, 3).map(([x = 0, y = 0, z = 0]): Vec3 => [x, y, z]);
  const section = vectorsOf(values.crossSection, 2).map(([x = 0, z = 0]): readonly [number, number] => [x, z]);
  if (spine.length < 2 || section.length < 2) return undefined;
  const scales = vectorsOf(values.scale, 2),
    rotations = vectorsOf(values.orientation, 4);
  const positions = framesAlong(spine).flatMap((frame, i) => {
    const [scaleX = 1, scaleZ = 1] = scales[Math.min(i, scales.length - 1)] ?? [];
    const rotation = rotations[Math.min(i, rotations.length - 1)] ?? [];
    return section.flatMap(([x, z]) =>
      pointInFrame(frame, rotated([x * scaleX, 0, z * scaleZ], rotation), spine[i] ?? origin),
    );
  });
  const builder = new FaceBuilder(spine, section, positions);
  builder.addSides();
  if (values.beginCap) builder.addCap(0, true);
  if (values.endCap) builder.addCap(spine.length - 1, false);
  return builder.surface;
}

const origin: Vec3 = [0, 0, 0];

function vectorsOf(numbers: readonly number[], size: number): number[][] {
  return Array.from({ length: Math.floor(numbers.length / size) }, (_, i) => numbers.slice(size * i, size * i + size));
}

function pointInFrame([x, y, z]: Frame, point: Vec3, origin: Vec3): number[] {
  return [0, 1, 2].map(
    (i) => (origin[i] ?? 0) + (x[i] ?? 0) * point[0] + (y[i] ?? 0) * point[1] + (z[i] ?? 0) * point[2],
  );
}

function isClosed(first: readonly number[] | undefined, last: readonly number[] | undefined): boolean {
  return first?.every((value, i) => value === last?.[i]) === true;
}

/** The spine-aligned cross-section planes (13.3.5.4): y is tangent to the spine, z normal to its bend. */
function framesAlong(spine: readonly Vec3[]): Frame[] {
  const count = spine.length,
    isLoop = count > 2 && isClosed(spine[0], spine[count - 1]);
  const pointAt = (i: number) =>
    spine[isLoop ? (i + count - 1) % (count - 1) : Math.min(Math.max(i, 0), count - 1)] ?? origin;
  const tangents = withGapsFilled(spine.map((_, i) => unit(minus(pointAt(i + 1), pointAt(i - 1)))));
  const bendNormals = withGapsFilled(
    spine.map((_, i) => unit(cross(minus(pointAt(i + 1), pointAt(i)), minus(pointAt(i - 1), pointAt(i))))),
  );
  if (tangents === undefined)
    return spine.map(() => [
      [1, 0, 0],
      [0, 1, 0],
      [0, 0, 1],
    ]);
  if (bendNormals === undefined) return tangents.map((tangent) => straightFrame(tangent));
  let previousZ: Vec3 | undefined;
  return tangents.map((y, i): Frame => {
    let z = bendNormals[i] ?? origin;
    if (previousZ !== undefined && dot(z, previousZ) < 0) z = minus(origin, z);
    previousZ = z;
    const x = unit(cross(y, z)) ?? [1, 0, 0];
    return [x, y, z];
  });
}

/**
 * Replaces a missing vector by the one before it, or by the first if none is before. Undefined if all are missing.
 */
function withGapsFilled(vectors: readonly (Vec3 | undefined)[]): Vec3[] | undefined {
  let previous = vectors.find((vector) => vector !== undefined);
  if (previous === undefined) return undefined;
  return vectors.map((vector) => (previous = vector ?? previous) ?? origin);
}

/** The frame of a straight spine: the shortest rotation that takes the y axis onto the tangent, applied to the axes. */
function straightFrame(tangent: Vec3): Frame {
  const up: Vec3 = [0, 1, 0];
  const axis = cross(up, tangent),
    sine = Math.hypot(...axis);
  const rotation = sine > 1e-12 ? [...axis, Math.atan2(sine, tangent[1])] : [1, 0, 0, tangent[1] < 0 ? Math.PI : 0];
  return [rotated([1, 0, 0], rotation), rotated(up, rotation), rotated([0, 0, 1], rotation)];
}

class FaceBuilder {
  readonly #spine: readonly Vec3[];
  readonly #section: readonly (readonly [number, number])[];
  readonly #positions: number[];
  readonly #texCoords: number[] = [];
  readonly #faces: Corner[][] = [];

  constructor(spine: readonly Vec3[], section: readonly (readonly [number, number])[], positions: readonly number[]) {
    this.#spine = spine;
    this.#section = section;
    this.#positions = [...positions];
  }

  /**
   * Adds the quadrilaterals between rows. If a curve is closed, its ends share positions, so that the surface is smooth
   * there.
   */
  addSides(): void {
    const [rows, columns] = [this.#spine.length, this.#section.length];
    const isSectionClosed = columns > 2 && isClosed(this.#section[0], this.#section[columns - 1]);
    const isSpineClosed =
      rows > 2 && isClosed(this.#positions.slice(0, 3 * columns), this.#positions.slice(-3 * columns));
    for (let i = 0; i < rows; ++i)
      for (let j = 0; j < columns; ++j) this.#texCoords.push(j / (columns - 1), i / (rows - 1));
    const corner = (i: number, j: number): Corner => ({
      position: (isSpineClosed ? i % (rows - 1) : i) * columns + (isSectionClosed ? j % (columns - 1) : j),
      texCoord: i * columns + j,
      normal: -1,
      color: -1,
    });
    for (let i = 0; i + 1 < rows; ++i) {
      for (let j = 0; j + 1 < columns; ++j)
        this.#faces.push([corner(i, j), corner(i, j + 1), corner(i + 1, j + 1), corner(i + 1, j)]);
    }
  }

  /** Adds the polygon that closes an end, with vertices of its own, because its rim is a hard edge. */
  addCap(row: number, isReversed: boolean): void {
    const columns = this.#section.length;
    const corners = isClosed(this.#section[0], this.#section[columns - 1]) ? columns - 1 : columns;
    if (corners < 3) return;
    const coordinates = (axis: 0 | 1) => this.#section.map((point) => point[axis]);
    const [minX, minZ] = [Math.min(...coordinates(0)), Math.min(...coordinates(1))];
    const extent = Math.max(Math.max(...coordinates(0)) - minX, Math.max(...coordinates(1)) - minZ) || 1;
    const face: Corner[] = [];
    for (let j = 0; j < corners; ++j) {
      const [x = 0, z = 0] = this.#section[j] ?? [];
      face.push({ position: this.#positions.length / 3, texCoord: this.#texCoords.length / 2, normal: -1, color: -1 });
      this.#positions.push(...this.#positions.slice(3 * (row * columns + j), 3 * (row * columns + j) + 3));
      this.#texCoords.push((x - minX) / extent, (isReversed ? z - minZ : extent - (z - minZ)) / extent);
    }
    this.#faces.push(isReversed ? face.reverse() : face);
  }

  get surface(): Surface {
    return {
      data: { positions: this.#positions, normals: [], texCoords: this.#texCoords, colors: [], colorComponents: 3 },
      faces: this.#faces,
    };
  }
}
