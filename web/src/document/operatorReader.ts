// Reads the field `operators` of geometry nodes, and maps the boxes of their shapes.

import type { Box3, GeometryDescription } from "./description.ts";
import { boxAround } from "./geometry.ts";
import { boxOfGeometry } from "./geometryBox.ts";
import { frameOfBox, operatedBoxInFrame } from "./operatorFrame.ts";
import type { Operator } from "./operators.ts";
import { readOperators } from "./readOperators.ts";

export interface OperatorReader {
  /** `problem`: a sentence where the text cannot be read, or not be applied to the geometry. */
  read(
    text: string,
    geometry: GeometryDescription,
  ): { readonly operators: readonly Operator[]; readonly problem?: string | undefined };
  /** A box around the mapped vertices of a geometry, whose own vertices lie in `box`. */
  boxOf(operators: readonly Operator[], geometry: GeometryDescription, box: Box3): Box3;
}

export const operatorReader: OperatorReader = { read, boxOf };

function read(text: string, geometry: GeometryDescription): ReturnType<OperatorReader["read"]> {
  const list = readOperators(text, geometry.encoding === "classic");
  const hasBox =
    geometry.coordType !== "Float32" || geometry.patches.length <= 1 || boxOfGeometry(geometry) !== undefined;
  return hasBox || list.operators.length === 0
    ? list
    : {
        operators: [],
        problem: `operators="${text}": floats in several patches need a box, of each or of the Shape; none is applied`,
      };
}

function boxOf(operators: readonly Operator[], geometry: GeometryDescription, box: Box3): Box3 {
  if (operators.length === 0 || geometry.encoding === "live") return box; // a stream states the decode box
  const { coordType, position, size } = geometry;
  const frame = coordType === "Float32" ? (boxOfGeometry(geometry) ?? box) : boxAround(position, size);
  return operatedBoxInFrame(operators, frameOfBox(frame), box);
}
