// How cameras see a mesh with levels of detail: the views of all its instances, in the units of its index.

import { dequantizationOf } from "../document/dequantization.ts";
import type { GeometryDescription, Vec3 } from "../document/description.ts";
import { boxAround } from "../document/geometry.ts";
import type { Box, Camera, Matrix } from "../scheduler/viewMetrics.ts";
import type { LevelView } from "./projectedError.ts";

/** A camera that sees a scene. */
export interface SceneView {
  /** In world coordinates. */
  readonly camera: Camera;
  /** Whether the camera's `pixelsPerUnit` holds at any distance. */
  readonly isOrthographic: boolean;
  /** Absent: the scene's coordinates are those of the world. */
  readonly worldFromScene?: Matrix;
}

/** An instance of a mesh in a scene. */
interface Instance {
  readonly sceneFromShape: Matrix;
}

/** One view for each camera and instance; none without a camera: then roots alone are needed. */
export function levelViewsOf(
  geometry: GeometryDescription,
  { views, instances }: { readonly views: readonly SceneView[]; readonly instances: Iterable<Instance> },
): LevelView[] {
  const all = sceneFromLatticesOf(geometry, instances);
  const box = latticeBoxOf(geometry);
  return views.flatMap(({ camera, isOrthographic, worldFromScene }) =>
    all.map((sceneFromLattice) => ({
      camera,
      isOrthographic,
      sceneFromLattice: worldFromScene ? product(worldFromScene, sceneFromLattice) : sceneFromLattice,
      box,
    })),
  );
}

/** The bounds that the document states for the mesh, or else those of the lattice, in lattice steps. */
function latticeBoxOf(geometry: GeometryDescription): Box {
  const [patch] = geometry.patches;
  if (patch === undefined) return { min: [0, 0, 0], max: [0, 0, 0] };
  const { origin, step } = dequantizationOf(geometry, patch);
  const { min, max } = patch.box ?? boxAround(geometry.position, geometry.size);
  const latticePoint = (point: Vec3): Vec3 => [
    (point[0] - origin[0]) / step[0],
    (point[1] - origin[1]) / step[1],
    (point[2] - origin[2]) / step[2],
  ];
  return { min: latticePoint(min), max: latticePoint(max) };
}

/** From lattice steps of the mesh to the scene, for each instance. */
export function sceneFromLatticesOf(geometry: GeometryDescription, instances: Iterable<Instance>): Matrix[] {
  const [patch] = geometry.patches;
  if (patch === undefined) return [];
  const { origin, step } = dequantizationOf(geometry, patch);
  return Array.from(instances, ({ sceneFromShape }) => scaledAndMoved(sceneFromShape, step, origin));
}

/** The matrix of `second` followed by `first`. */
function product(first: Matrix, second: Matrix): number[] {
  return Array.from({ length: 16 }, (_, i) =>
    [0, 1, 2, 3].reduce((sum, k) => sum + (first[4 * k + (i % 4)] ?? 0) * (second[4 * Math.floor(i / 4) + k] ?? 0), 0),
  );
}

/** The matrix of a scaling and a translation, followed by `matrix`. */
function scaledAndMoved(matrix: Matrix, scale: readonly number[], translation: readonly number[]): Matrix {
  const column = (n: number) => [0, 1, 2, 3].map((row) => matrix[4 * n + row] ?? 0);
  const axes = [0, 1, 2].map((axis) => column(axis).map((value) => value * (scale[axis] ?? 1)));
  const moved = column(3).map((value, row) =>
    [0, 1, 2].reduce((sum, axis) => sum + (matrix[4 * axis + row] ?? 0) * (translation[axis] ?? 0), value),
  );
  return [...axes.flat(), ...moved];
}
