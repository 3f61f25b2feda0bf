// The part "operators": the field `operators` of geometry nodes.

import { lateOperators } from "../../render/operators/lateOperators.ts";
import { operatorChunk } from "../../render/operators/operatorChunk.ts";
import { formatOf, StageOperation } from "../../render/operators/stageOperation.ts";
import { operatedBounds } from "../../scene/operatorFrame.ts";

export { operatorReader } from "../../document/operatorReader.ts";

export function add(): void {
  lateOperators.add({
    vertexChunk: operatorChunk,
    formatOf,
    StageOperation,
    boundsOf: operatedBounds,
  });
}
