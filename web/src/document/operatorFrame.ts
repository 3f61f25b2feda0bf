// The box in which operators map points: its sides are the unit box of operators.ts.

import type { Vec3 } from "./fieldTypes.ts";
import type { Box3 } from "./geometryDescription.ts";
import type { Operator } from "./operators.ts";
import { operatedBox, operatedPoint } from "./operators.ts";

export interface OperatorFrame {
  readonly min: Vec3;
  readonly size: Vec3;
}

/** A flat box has a thickness, too: that of its longest side. */
export function frameOfBox({ min, max }: Box3): OperatorFrame {
  const size: Vec3 = [max[0] - min[0], max[1] - min[1], max[2] - min[2]];
  const longest = Math.max(...size) || 1;
  const along = (axis: 0 | 1 | 2) => (size[axis] > 0 ? size[axis] : longest);
  return { min, size: [along(0), along(1), along(2)] };
}

export function operatedInFrame(operators: readonly Operator[], frame: OperatorFrame, point: Vec3): Vec3 {
  return fromUnit(operatedPoint(operators, toUnit(point, frame)), frame);
}

export function operatedBoxInFrame(operators: readonly Operator[], frame: OperatorFrame, box: Box3): Box3 {
  const unit = operatedBox(operators, { min: toUnit(box.min, frame), max: toUnit(box.max, frame) });
  return { min: fromUnit(unit.min, frame), max: fromUnit(unit.max, frame) };
}

function toUnit(point: Vec3, { min, size }: OperatorFrame): Vec3 {
  return [(point[0] - min[0]) / size[0], (point[1] - min[1]) / size[1], (point[2] - min[2]) / size[2]];
}

function fromUnit(point: Vec3, { min, size }: OperatorFrame): Vec3 {
  return [min[0] + point[0] * size[0], min[1] + point[1] * size[1], min[2] + point[2] * size[2]];
}
