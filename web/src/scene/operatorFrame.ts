// The box whose points operators map, in stored coordinates.

import type { Box3, GeometryDescription, PatchDescription } from "../document/description.ts";
import { dequantizationOf } from "../document/dequantization.ts";
import { boxAround } from "../document/geometry.ts";
import { boxOfGeometry } from "../document/geometryBox.ts";
import type { OperatorFrame } from "../document/operatorFrame.ts";
import { frameOfBox, operatedBoxInFrame } from "../document/operatorFrame.ts";
import type { Operator } from "../document/operators.ts";

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

/** A box around the mapped vertices of a patch, for which the document states none. */
export function operatedBounds(operators: readonly Operator[], geometry: GeometryDescription, bounds: Box3): Box3 {
  return operatedBoxInFrame(operators, frameOfBox(shapeBoxOf(geometry, bounds)), bounds);
}

function shapeBoxOf(geometry: GeometryDescription, bounds: Box3 | undefined): Box3 {
  const decodeBox = boxAround(geometry.position, geometry.size);
  return geometry.coordType === "Float32" ? (boxOfGeometry(geometry) ?? bounds ?? decodeBox) : decodeBox;
}
