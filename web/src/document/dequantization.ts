// From stored integers to points of the shape: the decode box as an origin and a
// step per axis ("Stored values" in docs/formats/nodes.md). It becomes a matrix,
// so that shaders and buffers keep the integers and the one conversion happens
// in double precision, together with the camera's.

import type { GeometryDescription, PatchDescription, Vec3 } from "./description.ts";
import { formatOf } from "./encodings.ts";

/** A point is origin + stored * step, axis by axis. */
export interface Dequantization {
  readonly origin: Vec3;
  readonly step: Vec3;
}

/** The stored value that stands for the far side of the decode box. */
export function maxStoredValueOf(geometry: GeometryDescription, patch: PatchDescription): number {
  return formatOf(geometry).maxStoredValue(geometry, patch);
}

export function dequantizationOf(geometry: GeometryDescription, patch: PatchDescription): Dequantization {
  const { position, size } = geometry;
  if (geometry.coordType === "Float32") return { origin: [0, 0, 0], step: [1, 1, 1] };
  const maxStored = maxStoredValueOf(geometry, patch);
  // Signed coordinates spread around the centre; X3DOM gives them half the range, -PMAX/2 .. PMAX/2.
  const signed = geometry.coordType.startsWith("Int");
  const along = (axis: 0 | 1 | 2) => (signed ? position[axis] : position[axis] - size[axis] / 2);
  // A flat box would make a matrix without an inverse; what is stored along its thin axis is 0.
  const edge = (axis: 0 | 1 | 2) => size[axis] || Math.max(...size) || 1;
  return {
    origin: [along(0), along(1), along(2)],
    step: [edge(0) / maxStored, edge(1) / maxStored, edge(2) / maxStored],
  };
}

/**
 * What stands for the bytes of a coordinate that have not come: the middle of
 * the values that they may hold, which halves the worst error of X3DOM's
 * stretching (b0 / 255) and moves a vertex by at most half a coarse step when
 * the next plane comes. With `positionBits` the lowest bits are known to be 0.
 */
export function missingBytesMidpoint(geometry: GeometryDescription, planes: number, planesPresent: number): number {
  if (planesPresent >= planes) return 0;
  const bits = geometry.positionBits > 0 ? Math.min(geometry.positionBits, 8 * planes) : 8 * planes;
  const missingBits = 8 * (planes - planesPresent);
  const unusedBits = Math.min(missingBits, 8 * planes - bits);
  return (2 ** missingBits - 2 ** unusedBits) / 2;
}
