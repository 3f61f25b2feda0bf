// The part "batches": shapes of scenes with many instances, drawn together.

import { BatchedStage } from "../../render/batches/batchedStage.ts";
import { Batches } from "../../render/batches/batches.ts";
import { batchMakers } from "../../render/batches/lateBatches.ts";

export function add(): void {
  batchMakers.add({
    batches: (...needed) => new Batches(...needed),
    stage: (...needed) => new BatchedStage(...needed),
  });
}
