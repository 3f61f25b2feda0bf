// How cameras see a mesh with levels of detail: the views of all its instances, in the units of its index.

import { dequantizationOf } from "../../document/dequantization.ts";
import type { GeometryDescription } from "../../document/description.ts";
import type { LevelView } from "../../levels/projectedError.ts";
import type { Matrix } from "../../scheduler/viewMetrics.ts";
import type { GeometryView } from "../geometryView.ts";

/** One view for each instance; none without a camera. */
export function levelViewsOf(
  geometry: GeometryDescription,
  { camera, isOrthographic, instances }: GeometryView,
): LevelView[] {
  const [patch] = geometry.patches;
  if (camera === undefined || patch === undefined) return [];
  const { origin, step } = dequantizationOf(geometry, patch);
  return Array.from(instances, ({ sceneFromShape }) => ({
    camera,
    isOrthographic,
    sceneFromLattice: scaledAndMoved(sceneFromShape, step, origin),
  }));
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
