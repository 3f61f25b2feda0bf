// The box around a geometry, as the document states it.

import type { Box3, GeometryDescription } from "./description.ts";
import type { Vec3 } from "./fieldTypes.ts";
import { boxAround, isUnbounded } from "./geometry.ts";

const boxesOfGeometries = new WeakMap<GeometryDescription, { readonly box: Box3 | undefined }>();

/**
 * The union of the patches' boxes; the quantization box, which contains them all, where a patch has none; undefined
 * where the bounds depend on the vertices. Computed once: each of many patches asks for it.
 */
export function boxOfGeometry(geometry: GeometryDescription): Box3 | undefined {
  const known = boxesOfGeometries.get(geometry) ?? { box: unionOfPatches(geometry) };
  boxesOfGeometries.set(geometry, known);
  return known.box;
}

function unionOfPatches(geometry: GeometryDescription): Box3 | undefined {
  if (geometry.patches.some((patch) => isUnbounded(geometry, patch))) return undefined;
  const boxes = geometry.patches.map((patch) => patch.box);
  const known = boxes.filter((box) => box !== undefined);
  if (known.length === 0 || known.length < boxes.length) return boxAround(geometry.position, geometry.size);
  const along = (pick: (box: Box3) => Vec3, choose: (...values: number[]) => number): Vec3 =>
    [0, 1, 2].map((axis) => choose(...known.map((box) => pick(box)[axis] ?? 0))) as unknown as Vec3;
  return { min: along((box) => box.min, Math.min), max: along((box) => box.max, Math.max) };
}
