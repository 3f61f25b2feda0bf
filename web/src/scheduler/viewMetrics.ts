// How a box is seen: whether it is inside the view, how large, and how finely.
// Numbers only, no camera of any library; matrices are 16 numbers, column by
// column, as WebGL has them.

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

/** A camera with a perspective, in the scene's coordinates. */
export interface Camera {
  readonly position: Point;
  /** Inside is where x nx + y ny + z nz + w >= 0, for each [nx, ny, nz, w] with a normal of length 1. */
  readonly planes: readonly (readonly [number, number, number, number])[];
  /** Pixels of the screen that something of length 1 covers at a distance of 1, in the middle of the view. */
  readonly pixelsPerUnit: number;
  /** Nothing is nearer than this. */
  readonly near: number;
}

/** What the camera sees of something. */
export interface ViewMetrics {
  /** Its diameter on the screen, if the camera were turned to it. */
  readonly pixels: number;
  readonly isInView: boolean;
  /** How large a length of 1 is where it is nearest. */
  readonly pixelsPerUnit: number;
}

/** Before a camera is known: everything is seen, and everything matters. */
export const unknownViewMetrics: ViewMetrics = { pixels: 1, isInView: true, pixelsPerUnit: Infinity };

export function viewMetricsOf({ center, radius }: Sphere, camera: Camera): ViewMetrics {
  const distance = Math.hypot(
    center[0] - camera.position[0],
    center[1] - camera.position[1],
    center[2] - camera.position[2],
  );
  return {
    // From inside of it, it is as large as what lies a radius away.
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
  // The farthest corner: its coordinates are sums of the half edges' images with some signs.
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

/** By how much a shape's longest axis is longer in the scene. */
export function scaleOf(sceneFromShape: Matrix): number {
  return Math.max(
    ...[0, 4, 8].map((column) =>
      Math.hypot(at(sceneFromShape, column), at(sceneFromShape, column + 1), at(sceneFromShape, column + 2)),
    ),
  );
}

/** The six sides of what a camera sees, from its projection times its view (Gribb and Hartmann 2001). */
export function planesOf(clipFromScene: Matrix): Camera["planes"] {
  const row = (n: number) => [0, 4, 8, 12].map((column) => at(clipFromScene, column + n));
  const last = row(3);
  return [0, 1, 2].flatMap((n) =>
    [1, -1].map((sign) => {
      const [x = 0, y = 0, z = 0, w = 0] = last.map((value, place) => value + sign * at(row(n), place));
      const length = Math.hypot(x, y, z) || 1;
      return [x / length, y / length, z / length, w / length] as const;
    }),
  );
}

function at(numbers: ArrayLike<number>, place: number): number {
  return numbers[place] ?? 0;
}
