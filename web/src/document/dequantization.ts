// Dequantization of stored integers to shape coordinates: an origin and a step per axis ("Stored values" in
// docs/formats/nodes.md). Renderers put it into the model matrix in double precision, so that buffers keep the
// integers.

import type { GeometryDescription, PatchDescription, Vec3 } from "./description.ts";
import { formatOf } from "./encodings.ts";

/** A point is origin + stored * step, axis by axis. */
export interface Dequantization {
  readonly origin: Vec3;
  readonly step: Vec3;
}

/** The stored value of the upper side of the quantization box. */
export function maxStoredValueOf(geometry: GeometryDescription, patch: PatchDescription): number {
  return formatOf(geometry).maxStoredValue(geometry, patch);
}

export function dequantizationOf(geometry: GeometryDescription, patch: PatchDescription): Dequantization {
  const { position, size } = geometry;
  if (geometry.coordType === "Float32") return { origin: [0, 0, 0], step: [1, 1, 1] };
  const maxStored = maxStoredValueOf(geometry, patch);
  // Signed coordinates are relative to the center; X3DOM maps -PMAX/2 … PMAX/2 to the box.
  const signed = geometry.coordType.startsWith("Int");
  const originAlong = (axis: 0 | 1 | 2) => (signed ? position[axis] : position[axis] - size[axis] / 2);
  // A flat box would make a singular matrix; the values stored along its thin axis are 0.
  const edgeAlong = (axis: 0 | 1 | 2) => size[axis] || Math.max(...size) || 1;
  return {
    origin: [originAlong(0), originAlong(1), originAlong(2)],
    step: [edgeAlong(0) / maxStored, edgeAlong(1) / maxStored, edgeAlong(2) / maxStored],
  };
}

/**
 * Stands in for coordinate bytes whose planes have not arrived: the midpoint of the values that the bytes may have. It
 * halves the largest error of X3DOM's scaling (b0 / 255) and moves a vertex by at most half a coarse step when the next
 * plane arrives. With `positionBits` the lowest bits are known to be 0.
 */
export function missingBytesMidpoint(geometry: GeometryDescription, planes: number, planesPresent: number): number {
  if (planesPresent >= planes) return 0;
  const bits = geometry.positionBits > 0 ? Math.min(geometry.positionBits, 8 * planes) : 8 * planes;
  const missingBits = 8 * (planes - planesPresent);
  const unusedBits = Math.min(missingBits, 8 * planes - bits);
  return (2 ** missingBits - 2 ** unusedBits) / 2;
}
