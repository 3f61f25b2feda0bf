// From stored integers to points of the shape: the decode box as an origin and a
// step per axis ("Stored values" in docs/formats/nodes.md). It becomes a matrix,
// so that shaders and buffers keep the integers and the one conversion happens
// in double precision, together with the camera's.

import type { ElementType, GeometryDescription, PatchDescription, Vec3 } from "./description.ts";

/** A point is origin + stored * step, axis by axis. */
export interface Dequantization {
  readonly origin: Vec3;
  readonly step: Vec3;
}

/** The largest value of each element type, which stands for 1 (X3DOM's PMAX). */
const largestValue: Readonly<Record<ElementType, number>> = {
  Int8: 127,
  Uint8: 255,
  Int16: 32767,
  Uint16: 65535,
  Int32: 2147483647,
  Uint32: 4294967295,
  Float32: 1,
};

/** The stored value that stands for the far side of the decode box. */
export function maxStoredValueOf(geometry: GeometryDescription, patch: PatchDescription): number {
  switch (geometry.container) {
    case "compact":
      return largestLatticeValue(latticeBitsOf(geometry));
    case "sig":
      return 256 ** Math.max(1, patch.coord.length) - 1;
    case "bg":
      return largestValue[geometry.coordType];
  }
}

export function dequantizationOf(geometry: GeometryDescription, patch: PatchDescription): Dequantization {
  const { position, size } = geometry;
  if (geometry.container === "bg" && geometry.coordType === "Float32") return { origin: [0, 0, 0], step: [1, 1, 1] };
  const largest = maxStoredValueOf(geometry, patch);
  // Signed coordinates spread around the centre; X3DOM gives them half the range, -PMAX/2 .. PMAX/2.
  const signed = geometry.container === "bg" && geometry.coordType.startsWith("Int");
  const along = (axis: 0 | 1 | 2) => (signed ? position[axis] : position[axis] - size[axis] / 2);
  // A flat box would make a matrix without an inverse; what is stored along its thin axis is 0.
  const edge = (axis: 0 | 1 | 2) => size[axis] || Math.max(...size) || 1;
  return {
    origin: [along(0), along(1), along(2)],
    step: [edge(0) / largest, edge(1) / largest, edge(2) / largest],
  };
}

/** Of SIG compact. */
export function latticeBitsOf({ positionBits }: GeometryDescription): number {
  return positionBits > 0 ? positionBits : 16;
}

/** The box is spread over whole bytes, of which the lattice has the upper bits; its numbers come without the lower ones. */
function largestLatticeValue(bits: number): number {
  const bytes = Math.ceil(bits / 8);
  return (256 ** bytes - 1) / 2 ** (8 * bytes - bits);
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
