// Vectors as the numbers of a document, for what is computed of them before anything
// is drawn.

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

/** Undefined for what has no direction. */
export function unit(vector: Vec3): Vec3 | undefined {
  const length = Math.hypot(...vector);
  return length > 1e-12 ? [vector[0] / length, vector[1] / length, vector[2] / length] : undefined;
}

/** Rodrigues' rotation by axis and angle. */
export function rotated(vector: Vec3, [x = 0, y = 0, z = 1, angle = 0]: readonly number[]): Vec3 {
  const axis = unit([x, y, z]);
  if (axis === undefined || angle === 0) return vector;
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  const [side, along] = [cross(axis, vector), dot(axis, vector) * (1 - cos)];
  const turn = (i: 0 | 1 | 2) => vector[i] * cos + side[i] * sin + axis[i] * along;
  return [turn(0), turn(1), turn(2)];
}
