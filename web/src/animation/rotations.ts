// Rotations of X3D, axis and angle in radians, as unit quaternions (x, y, z, w).

export type Rotation = readonly [x: number, y: number, z: number, angle: number];
export type Quaternion = readonly [x: number, y: number, z: number, w: number];

/** A scene may turn a thousand Transforms in every frame, and Math.hypot takes several times as long. */
function lengthOf(x: number, y: number, z: number): number {
  return Math.sqrt(x * x + y * y + z * z);
}

/** The identity for an axis without length. */
export function quaternionOf(x: number, y: number, z: number, angle: number): Quaternion {
  const length = lengthOf(x, y, z);
  if (length === 0) return [0, 0, 0, 1];
  const sine = Math.sin(angle / 2) / length;
  return [x * sine, y * sine, z * sine, Math.cos(angle / 2)];
}

/** Angle 0 … π. The axis of no rotation is z, X3D's default. */
export function rotationOf(q: Quaternion): Rotation {
  const sign = q[3] < 0 ? -1 : 1;
  const sine = lengthOf(q[0], q[1], q[2]);
  if (sine < 1e-12) return [0, 0, 1, 0];
  const scale = sign / sine;
  return [q[0] * scale, q[1] * scale, q[2] * scale, 2 * Math.atan2(sine, sign * q[3])];
}

function dot(a: Quaternion, b: Quaternion): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

function mix(a: Quaternion, weightA: number, b: Quaternion, weightB: number): Quaternion {
  return [
    a[0] * weightA + b[0] * weightB,
    a[1] * weightA + b[1] * weightB,
    a[2] * weightA + b[2] * weightB,
    a[3] * weightA + b[3] * weightB,
  ];
}

export function multiply(a: Quaternion, b: Quaternion): Quaternion {
  return [
    a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
    a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
    a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3],
    a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2],
  ];
}

export function conjugate([x, y, z, w]: Quaternion): Quaternion {
  return [-x, -y, -z, w];
}

export function normalized(q: Quaternion): Quaternion {
  const length = Math.hypot(...q);
  return length === 0 ? [0, 0, 0, 1] : [q[0] / length, q[1] / length, q[2] / length, q[3] / length];
}

/** The vector turned by the quaternion. */
export function turned([x, y, z]: readonly number[], q: Quaternion): [number, number, number] {
  const [a, b, c] = multiply(multiply(q, [x ?? 0, y ?? 0, z ?? 0, 0]), conjugate(q));
  return [a, b, c];
}

/** The shorter way from one rotation to another. */
export interface Arc {
  readonly from: Quaternion;
  /** The end, as the quaternion nearest to `from`. */
  readonly to: Quaternion;
  /** Half the angle of the way, and its sine. */
  readonly angle: number;
  readonly sine: number;
}

export function arcBetween(from: Quaternion, to: Quaternion): Arc {
  const end = nearest(to, from);
  const angle = Math.acos(Math.min(1, dot(from, end)));
  return { from, to: end, angle, sine: Math.sin(angle) };
}

/** The rotation at a point of an arc, with constant angular speed. `t`: 0 … 1. */
export function pointOf({ from, to, angle, sine }: Arc, t: number): Quaternion {
  if (sine < 1e-9) return normalized(mix(from, 1 - t, to, t));
  return mix(from, Math.sin((1 - t) * angle) / sine, to, Math.sin(t * angle) / sine);
}

/** Rotations about one axis, from one angle to another. */
export interface Turn {
  /** A unit vector. */
  readonly axis: readonly [x: number, y: number, z: number];
  readonly angle: number;
  /** From `angle` to that of the end: -π … π. */
  readonly difference: number;
}

/** The shorter way between two rotations about one axis, as `arcBetween` has it; undefined if their axes differ. */
export function turnBetween(from: Rotation, to: Rotation): Turn | undefined {
  const begin = unitAxisOf(from) ?? unitAxisOf(to);
  const end = unitAxisOf(to) ?? begin;
  if (begin === undefined || end === undefined) return undefined;
  const cosine = begin[0] * end[0] + begin[1] * end[1] + begin[2] * end[2];
  if (1 - Math.abs(cosine) > 1e-12) return undefined;
  const angle = unitAxisOf(from) ? from[3] : 0;
  const difference = (unitAxisOf(to) ? Math.sign(cosine) * to[3] : 0) - angle;
  const turns = Math.abs(difference) <= Math.PI ? 0 : Math.round(difference / (2 * Math.PI));
  return { axis: begin, angle, difference: difference - 2 * Math.PI * turns };
}

/** Undefined where nothing is turned. */
function unitAxisOf([x, y, z, angle]: Rotation): Turn["axis"] | undefined {
  const length = lengthOf(x, y, z);
  return length === 0 || angle === 0 ? undefined : [x / length, y / length, z / length];
}

/** The rotation between two, with constant angular speed along the shorter way. `t`: 0 … 1. */
export function slerp(a: Quaternion, b: Quaternion, t: number): Quaternion {
  return pointOf(arcBetween(a, b), t);
}

/** The same rotation as `q`, as the quaternion nearest to `to`. */
function nearest(q: Quaternion, to: Quaternion): Quaternion {
  return dot(q, to) < 0 ? [-q[0], -q[1], -q[2], -q[3]] : q;
}

/** The logarithm of a unit quaternion, whose w is 0. */
function logarithm([x, y, z, w]: Quaternion): Quaternion {
  const sine = Math.hypot(x, y, z);
  if (sine < 1e-12) return [0, 0, 0, 0];
  const scale = Math.atan2(sine, w) / sine;
  return [x * scale, y * scale, z * scale, 0];
}

function exponential([x, y, z]: Quaternion): Quaternion {
  const angle = Math.hypot(x, y, z);
  const scale = angle < 1e-12 ? 1 : Math.sin(angle) / angle;
  return [x * scale, y * scale, z * scale, Math.cos(angle)];
}

/** The control point of Shoemake's spherical spline at a key, from the rotations before, at and after it. */
export function squadControl(before: Quaternion, at: Quaternion, after: Quaternion): Quaternion {
  const inverse = conjugate(at);
  const a = logarithm(multiply(inverse, nearest(after, at)));
  const b = logarithm(multiply(inverse, nearest(before, at)));
  return multiply(at, exponential(mix(a, -1 / 4, b, -1 / 4)));
}

/** Spherical cubic between `from` and `to`, whose control points are `controlFrom` and `controlTo`. */
export function squad(
  from: Quaternion,
  controlFrom: Quaternion,
  controlTo: Quaternion,
  to: Quaternion,
  t: number,
): Quaternion {
  return slerp(slerp(from, to, t), slerp(controlFrom, controlTo, t), 2 * t * (1 - t));
}

/** The shortest rotation that turns one direction into the other. */
export function rotationBetween(from: readonly number[], to: readonly number[]): Quaternion {
  const [a = 0, b = 0, c = 0] = from;
  const [x = 0, y = 0, z = 0] = to;
  const lengths = Math.hypot(a, b, c) * Math.hypot(x, y, z);
  if (lengths === 0) return [0, 0, 0, 1];
  const w = lengths + a * x + b * y + c * z;
  // Opposite directions: half a turn about any axis across them.
  if (w < 1e-9 * lengths) return normalized(Math.abs(a) > Math.abs(c) ? [-b, a, 0, 0] : [0, -c, b, 0]);
  return normalized([b * z - c * y, c * x - a * z, a * y - b * x, w]);
}
