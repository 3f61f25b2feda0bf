// Cameras for tests, in the lattice of a mesh of 16 bits.

import type { TestRandom } from "../decode/compact/rangeEncoder.testing.ts";
import type { Camera, Point } from "../scheduler/viewMetrics.ts";
import { fraction } from "./levels.testing.ts";
import type { LevelView } from "./projectedError.ts";

interface ViewOptions {
  /** From the scene's center to the eye: the camera looks the other way. It lies in the plane of x and z. */
  readonly direction?: Point;
  readonly near?: number;
  readonly far?: number;
  /** The scale of the instance of the mesh. */
  readonly scale?: number;
  readonly pixelsPerUnit?: number;
}

/** That of the whole lattice. */
const box: LevelView["box"] = { min: [0, 0, 0], max: [65535, 65535, 65535] };

function scaling(scale: number): LevelView["sceneFromLattice"] {
  return [scale, 0, 0, 0, 0, scale, 0, 0, 0, 0, scale, 0, 0, 0, 0, 1];
}

type Plane = Camera["planes"][number];

function planeThrough(point: Point, normal: Point): Plane {
  const length = Math.hypot(...normal);
  const [x, y, z] = [normal[0] / length, normal[1] / length, normal[2] / length];
  return [x, y, z, -(x * point[0] + y * point[1] + z * point[2])];
}

const along = (point: Point, direction: Point, distance: number): Point => [
  point[0] + direction[0] * distance,
  point[1] + direction[1] * distance,
  point[2] + direction[2] * distance,
];

/** A frustum of 60 degrees in both directions. */
export function perspectiveView(eye: Point, options: ViewOptions): LevelView {
  const { direction = [0, 0, 1], near = 1, far = 1e7, scale = 1, pixelsPerUnit = 1000 } = options;
  const forward: Point = [-direction[0], -direction[1], -direction[2]];
  const right: Point = [direction[2], 0, -direction[0]];
  const [sine, cosine] = [Math.sin(Math.PI / 6), Math.cos(Math.PI / 6)];
  const side = (sign: number): Point => along([0, 0, 0], along(mul(forward, sine), right, sign * cosine), 1);
  const planes = [
    planeThrough(eye, side(1)),
    planeThrough(eye, side(-1)),
    planeThrough(eye, along(mul(forward, sine), [0, 1, 0], cosine)),
    planeThrough(eye, along(mul(forward, sine), [0, 1, 0], -cosine)),
    planeThrough(along(eye, forward, near), forward),
    planeThrough(along(eye, forward, far), direction),
  ];
  const camera = { position: eye, planes, pixelsPerUnit, near };
  return { camera, isOrthographic: false, sceneFromLattice: scaling(scale), box };
}

/** A view of 20,000 lattice steps in both directions. */
export function orthographicView(eye: Point, { direction = [0, 0, 1], scale = 1 }: ViewOptions): LevelView {
  const forward: Point = [-direction[0], -direction[1], -direction[2]];
  const right: Point = [direction[2], 0, -direction[0]];
  const planes = [
    planeThrough(along(eye, right, -10000), right),
    planeThrough(along(eye, right, 10000), mul(right, -1)),
    planeThrough(along(eye, [0, 1, 0], -10000), [0, 1, 0]),
    planeThrough(along(eye, [0, 1, 0], 10000), [0, -1, 0]),
    planeThrough(eye, forward),
    planeThrough(along(eye, forward, 1e7), direction),
  ];
  const camera = { position: eye, planes, pixelsPerUnit: 0.05, near: 1 };
  return { camera, isOrthographic: true, sceneFromLattice: scaling(scale), box };
}

function mul([x, y, z]: Point, factor: number): Point {
  return [x * factor, y * factor, z * factor];
}

/** A camera in or around the mesh, near or far, that looks anywhere. */
export function randomView(random: TestRandom): LevelView {
  const reach = 65536 * 4 ** (2 * fraction(random) - 1);
  const eye: Point = [
    32768 + reach * (2 * fraction(random) - 1),
    32768 + reach * (2 * fraction(random) - 1) * 0.5,
    32768 + reach * (2 * fraction(random) - 1) * 0.5,
  ];
  const angle = 2 * Math.PI * fraction(random);
  const direction: Point = [Math.sin(angle), 0, Math.cos(angle)];
  const make = random.below(4) === 0 ? orthographicView : perspectiveView;
  return make(eye, { direction, near: 1 + random.below(500) });
}
