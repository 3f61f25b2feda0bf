// Computes whether a bounding sphere is in view, its size in pixels, and the pixels per unit there. Matrices are 16
// numbers in column-major order, as WebGL has them; there is no dependency on a camera class.

export type Point = readonly [number, number, number];
export type Matrix = ArrayLike<number>;

export interface Box {
  readonly min: Point;
  readonly max: Point;
}

export interface Sphere {
  readonly center: Point;
  readonly radius: number;
}

/** A perspective camera, in the scene's coordinates. */
export interface Camera {
  readonly position: Point;
  /** The view frustum: points with x nx + y ny + z nz + w >= 0 for each [nx, ny, nz, w]; normals have length 1. */
  readonly planes: readonly (readonly [number, number, number, number])[];
  /** Pixels that a length of 1 covers at a distance of 1, in the middle of the view. */
  readonly pixelsPerUnit: number;
  /** Distance of the near plane. */
  readonly near: number;
}

/** What the camera sees of a sphere. */
export interface ViewMetrics {
  /** Its diameter in pixels, as if the camera looked at its center. */
  readonly pixels: number;
  readonly isInView: boolean;
  /** Pixels that a length of 1 covers at its nearest point. */
  readonly pixelsPerUnit: number;
}

/** Before a camera is known: everything is in view and equally important. */
export const unknownViewMetrics: ViewMetrics = { pixels: 1, isInView: true, pixelsPerUnit: Infinity };

export function viewMetricsOf({ center, radius }: Sphere, camera: Camera): ViewMetrics {
  const distance = Math.hypot(
    center[0] - camera.position[0],
    center[1] - camera.position[1],
    center[2] - camera.position[2],
  );
  return {
    // From inside the sphere the distance counts as its radius.
    pixels: (2 * radius * camera.pixelsPerUnit) / Math.max(distance, radius, camera.near),
    isInView: camera.planes.every(([x, y, z, w]) => x * center[0] + y * center[1] + z * center[2] + w >= -radius),
    pixelsPerUnit: camera.pixelsPerUnit / Math.max(distance - radius, camera.near),
  };
}

/** A sphere around a box of a shape, in the scene's coordinates. */
export function sphereOf({ min, max }: Box, sceneFromShape: Matrix): Sphere {
  const half = [0, 1, 2].map((axis) => (at(max, axis) - at(min, axis)) / 2);
  const middle = [0, 1, 2].map((axis) => (at(max, axis) + at(min, axis)) / 2);
  const center: Point = [0, 1, 2].map(
    (row) =>
      at(sceneFromShape, 12 + row) +
      [0, 1, 2].reduce((sum, axis) => sum + at(sceneFromShape, 4 * axis + row) * at(middle, axis), 0),
  ) as unknown as Point;
  // The farthest corner is a sum of the transformed half edges with some signs; opposite corners are equally far.
  let square = 0;
  for (const [signY, signZ] of [
    [1, 1],
    [1, -1],
    [-1, 1],
    [-1, -1],
  ] as const) {
    const corner = [0, 1, 2].reduce(
      (sum, row) =>
        sum +
        (at(sceneFromShape, row) * at(half, 0) +
          signY * at(sceneFromShape, 4 + row) * at(half, 1) +
          signZ * at(sceneFromShape, 8 + row) * at(half, 2)) **
          2,
      0,
    );
    square = Math.max(square, corner);
  }
  return { center, radius: Math.sqrt(square) };
}

/** The largest factor by which the matrix scales an axis. */
export function scaleOf(sceneFromShape: Matrix): number {
  return Math.max(
    ...[0, 4, 8].map((column) =>
      Math.hypot(at(sceneFromShape, column), at(sceneFromShape, column + 1), at(sceneFromShape, column + 2)),
    ),
  );
}

/**
 * The distance of a point of the scene from a transformed box. 0 where the matrix shears, so that the edges of the box
 * are not at right angles to one another.
 */
export function distanceToBox(point: Point, { min, max }: Box, sceneFromBox: Matrix): number {
  const fromOrigin = point.map((value, row) => value - at(sceneFromBox, 12 + row));
  const axes = [0, 4, 8].map((column) => [0, 1, 2].map((row) => at(sceneFromBox, column + row)));
  let square = 0;
  for (const [n, axis] of axes.entries()) {
    const length = Math.hypot(...axis);
    const next = axes[(n + 1) % 3] ?? [];
    if (!(Math.abs(dot(axis, next)) <= 1e-6 * length * Math.hypot(...next))) return 0;
    const along = length === 0 ? 0 : dot(axis, fromOrigin) / length;
    square += Math.max(0, at(min, n) * length - along, along - at(max, n) * length) ** 2;
  }
  return Math.sqrt(square);
}

function dot(a: ArrayLike<number>, b: ArrayLike<number>): number {
  return at(a, 0) * at(b, 0) + at(a, 1) * at(b, 1) + at(a, 2) * at(b, 2);
}

/** The six planes of the view frustum, from the projection times the view matrix (Gribb and Hartmann 2001). */
export function planesOf(clipFromScene: Matrix): Camera["planes"] {
  const row = (n: number) => [0, 4, 8, 12].map((column) => at(clipFromScene, column + n));
  const last = row(3);
  return [0, 1, 2].flatMap((n) =>
    [1, -1].map((sign) => {
      const [x = 0, y = 0, z = 0, w = 0] = last.map((value, column) => value + sign * at(row(n), column));
      const length = Math.hypot(x, y, z) || 1;
      return [x / length, y / length, z / length, w / length] as const;
    }),
  );
}

function at(numbers: ArrayLike<number>, index: number): number {
  return numbers[index] ?? 0;
}
