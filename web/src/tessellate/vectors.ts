// Arithmetic on 3D vectors as plain arrays.

export type Vec3 = readonly [number, number, number];

export function minus(a: Vec3, b: Vec3): Vec3 {
  return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}

export function cross(a: Vec3, b: Vec3): Vec3 {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

export function dot(a: Vec3, b: Vec3): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/** The vector at length 1; undefined for one no longer than 1e-12. */
export function unit(vector: Vec3): Vec3 | undefined {
  const length = Math.hypot(...vector);
  return length > 1e-12 ? [vector[0] / length, vector[1] / length, vector[2] / length] : undefined;
}

/** Rotates about an axis by an angle in radians (Rodrigues' formula); an axis without direction rotates nothing. */
export function rotated(vector: Vec3, [x = 0, y = 0, z = 1, angle = 0]: readonly number[]): Vec3 {
  const axis = unit([x, y, z]);
  if (axis === undefined || angle === 0) return vector;
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  const [side, along] = [cross(axis, vector), dot(axis, vector) * (1 - cos)];
  const component = (i: 0 | 1 | 2) => vector[i] * cos + side[i] * sin + axis[i] * along;
  return [component(0), component(1), component(2)];
}
