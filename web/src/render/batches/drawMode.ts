// The draw mode of a stage of a patch.

import type { AppearanceDescription } from "../../document/description.ts";
import type { Stage } from "../../stage/stage.ts";
import type { BatchingRules } from "../materials/materialFactory.ts";
import type { SurfaceTextures } from "../materials/surfaceTextures.ts";
import { applicableTextures } from "../materials/surfaceTextures.ts";
import { colorsOf } from "../stages/materialRequests.ts";
import type { DrawMode, DrawModes } from "./batchingPlan.ts";

/** The draw mode of a stage, given the modes of its geometry. */
export function drawModeOf(
  stage: Stage,
  modes: DrawModes,
  appearance: AppearanceDescription,
  surfaceTextures: SurfaceTextures,
  batching: BatchingRules,
): DrawMode {
  return isBlended(stage, appearance, surfaceTextures, batching) ? modes.blended : modes.opaque;
}

export function isBlended(
  stage: Stage,
  appearance: AppearanceDescription,
  surfaceTextures: SurfaceTextures,
  batching: BatchingRules,
): boolean {
  return batching.isBlended(
    { colors: colorsOf(stage) },
    appearance,
    applicableTextures(stage, appearance, surfaceTextures),
  );
}
