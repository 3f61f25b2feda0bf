// Computes the bounds of a stage in stored coordinates.

import { Box3, Sphere, Vector3 } from "three";
import type { GeometryDescription, PatchDescription } from "../../document/description.ts";
import { formatOf } from "../../document/encodings.ts";
import { boxAround } from "../../document/geometry.ts";
import { dequantizationOf, missingBytesMidpoint } from "../../document/dequantization.ts";
import type { Stage } from "../../stage/stage.ts";

/**
 * The patch's bounds in stored coordinates. The sphere has room for missing low bytes, which move vertices of coarse
 * stages.
 */
export function boundsOf(
  geometry: GeometryDescription,
  patch: PatchDescription,
  stage: Stage,
): { box: Box3; sphere: Sphere } {
  const { origin, step } = dequantizationOf(geometry, patch);
  const { min, max } = stage.bounds ?? patch.box ?? boxAround(geometry.position, geometry.size);
  const stored = (point: readonly [number, number, number]) =>
    new Vector3((point[0] - origin[0]) / step[0], (point[1] - origin[1]) / step[1], (point[2] - origin[2]) / step[2]);
  const box = new Box3(stored(min), stored(max));
  const slack =
    formatOf(geometry).storage === "bytePlanes"
      ? missingBytesMidpoint(geometry, patch.coord.length, 1) * Math.sqrt(3)
      : 0;
  return { box, sphere: new Sphere(box.getCenter(new Vector3()), box.min.distanceTo(box.max) / 2 + slack) };
}
