// Reads the field `operators` of geometry nodes, and maps the boxes of their shapes.

import type { Box3, GeometryDescription } from "./description.ts";
import { boxAround } from "./geometry.ts";
import type { Operator } from "./operators.ts";
import { operatedBox, readOperators } from "./operators.ts";
import type { Vec3 } from "./fieldTypes.ts";

export interface OperatorReader {
  /** `problem`: a sentence where the text cannot be read. */
  read(text: string): { readonly operators: readonly Operator[]; readonly problem?: string | undefined };
  /** A box around the mapped vertices of a geometry, whose own vertices lie in `box`. */
  boxOf(operators: readonly Operator[], geometry: GeometryDescription, box: Box3): Box3;
}

export const operatorReader: OperatorReader = { read: readOperators, boxOf };

function boxOf(operators: readonly Operator[], { coordType, position, size }: GeometryDescription, box: Box3): Box3 {
  if (operators.length === 0) return box;
  const { min, max } = coordType === "Float32" ? box : boxAround(position, size);
  const extent = max.map((high, axis) => high - (min[axis] ?? 0));
  const longest = Math.max(...extent) || 1;
  const edge = (axis: 0 | 1 | 2) => {
    const length = extent[axis] ?? 0;
    return length > 0 ? length : longest; // a flat box has a thickness, too
  };
  const inAxes = (map: (min: number, extent: number, axis: 0 | 1 | 2) => number): Vec3 => [
    map(min[0], edge(0), 0),
    map(min[1], edge(1), 1),
    map(min[2], edge(2), 2),
  ];
  const toUnit = (point: Vec3) => inAxes((low, length, axis) => (point[axis] - low) / length);
  const fromUnit = (point: Vec3) => inAxes((low, length, axis) => low + point[axis] * length);
  const unit = operatedBox(operators, { min: toUnit(box.min), max: toUnit(box.max) });
  return { min: fromUnit(unit.min), max: fromUnit(unit.max) };
}
