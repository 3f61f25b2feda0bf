// The box whose points operators map, in stored coordinates.

import type { Box3, GeometryDescription, PatchDescription, Vec3 } from "../document/description.ts";
import { dequantizationOf } from "../document/dequantization.ts";
import { boxAround } from "../document/geometry.ts";
import type { OperatorFrame } from "../document/operatorFrame.ts";
import { frameOfBox } from "../document/operatorFrame.ts";

/**
 * Quantized coordinates are mapped in their quantization box, floats in the box around the geometry. `bounds`: of the
 * vertices, where the document states none.
 */
export function operatorFrameOf(
  geometry: GeometryDescription,
  patch: PatchDescription,
  bounds: Box3 | undefined,
): OperatorFrame {
  const { origin, step } = dequantizationOf(geometry, patch);
  const { min, size } = frameOfBox(shapeBoxOf(geometry, bounds));
  return {
    min: [(min[0] - origin[0]) / step[0], (min[1] - origin[1]) / step[1], (min[2] - origin[2]) / step[2]],
    size: [size[0] / step[0], size[1] / step[1], size[2] / step[2]],
  };
}

function shapeBoxOf({ coordType, position, size, patches }: GeometryDescription, bounds: Box3 | undefined): Box3 {
  if (coordType !== "Float32") return boxAround(position, size);
  const boxes = patches.flatMap(({ box }) => box ?? []);
  if (boxes.length === 0 || boxes.length < patches.length) return bounds ?? boxAround(position, size);
  const along = (pick: (box: Box3) => Vec3, choose: (...values: number[]) => number): Vec3 =>
    [0, 1, 2].map((axis) => choose(...boxes.map((box) => pick(box)[axis] ?? 0))) as unknown as Vec3;
  return { min: along((box) => box.min, Math.min), max: along((box) => box.max, Math.max) };
}
