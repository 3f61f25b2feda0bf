// The part "deformation": shapes whose vertices joints and displacers move.

import { deformationChunk } from "../../render/deformation/deformationChunk.ts";
import { lateDeformation } from "../../render/deformation/lateDeformation.ts";
import { ShapePose } from "../../render/deformation/shapePose.ts";
import { StageDeformation } from "../../render/deformation/stageDeformation.ts";

export { deformationReader } from "../../document/deformationReader.ts";

export function add(): void {
  lateDeformation.add({
    vertexChunk: deformationChunk,
    pose: (...counts) => new ShapePose(...counts),
    ofStage: (...needed) => new StageDeformation(...needed),
  });
}
