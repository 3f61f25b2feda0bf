// The box whose points operators map, in stored coordinates, and what they map bounds to.

import type { Box3, GeometryDescription, PatchDescription, Vec3 } from "../document/description.ts";
import { dequantizationOf } from "../document/dequantization.ts";
import { boxAround } from "../document/geometry.ts";
import type { Operator } from "../document/operators.ts";
import { operatedBox, operatedPoint } from "../document/operators.ts";

export interface OperatorFrame {
  readonly min: Vec3;
  readonly size: Vec3;
}

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
  const box = shapeBoxOf(geometry, bounds);
  const size = box.max.map((max, axis) => max - (box.min[axis] ?? 0));
  const longest = Math.max(...size) || 1;
  const along = (axis: 0 | 1 | 2) => {
    const length = size[axis] ?? 0;
    return (length > 0 ? length : longest) / step[axis]; // a flat box has a thickness, too
  };
  return {
    min: [(box.min[0] - origin[0]) / step[0], (box.min[1] - origin[1]) / step[1], (box.min[2] - origin[2]) / step[2]],
    size: [along(0), along(1), along(2)],
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

export function operatedInFrame(operators: readonly Operator[], { min, size }: OperatorFrame, point: Vec3): Vec3 {
  return fromUnit(operatedPoint(operators, toUnit(point, min, size)), min, size);
}

export function operatedBoxInFrame(operators: readonly Operator[], { min, size }: OperatorFrame, box: Box3): Box3 {
  const unit = operatedBox(operators, { min: toUnit(box.min, min, size), max: toUnit(box.max, min, size) });
  return { min: fromUnit(unit.min, min, size), max: fromUnit(unit.max, min, size) };
}

function toUnit(point: Vec3, min: Vec3, size: Vec3): Vec3 {
  return [(point[0] - min[0]) / size[0], (point[1] - min[1]) / size[1], (point[2] - min[2]) / size[2]];
}

function fromUnit(point: Vec3, min: Vec3, size: Vec3): Vec3 {
  return [min[0] + point[0] * size[0], min[1] + point[1] * size[1], min[2] + point[2] * size[2]];
}
