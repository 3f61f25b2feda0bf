// Reads the field `operators` of geometry nodes, and maps the boxes of their shapes.

import type { Box3, GeometryDescription } from "./description.ts";
import { boxAround } from "./geometry.ts";
import { boxOfGeometry } from "./geometryBox.ts";
import { frameOfBox, operatedBoxInFrame } from "./operatorFrame.ts";
import type { Operator } from "./operators.ts";
import { readOperators } from "./operators.ts";

export interface OperatorReader {
  /** `problem`: a sentence where the text cannot be read. */
  read(text: string): { readonly operators: readonly Operator[]; readonly problem?: string | undefined };
  /** A box around the mapped vertices of a geometry, whose own vertices lie in `box`. */
  boxOf(operators: readonly Operator[], geometry: GeometryDescription, box: Box3): Box3;
}

export const operatorReader: OperatorReader = { read: readOperators, boxOf };

function boxOf(operators: readonly Operator[], geometry: GeometryDescription, box: Box3): Box3 {
  if (operators.length === 0) return box;
  const { coordType, position, size } = geometry;
  const frame = coordType === "Float32" ? (boxOfGeometry(geometry) ?? box) : boxAround(position, size);
  return operatedBoxInFrame(operators, frameOfBox(frame), box);
}
