// The part "walking": the navigation type WALK.

import { addWalkController } from "../../navigation/lateWalking.ts";
import { WalkController } from "../../navigation/walkController.ts";
import { DepthProbe } from "../../render/picking/depthProbe.ts";
import { addDepthProbe } from "../../render/picking/lateDepthProbe.ts";

export function add(): void {
  addWalkController(() => new WalkController());
  addDepthProbe((renderer) => new DepthProbe(renderer));
}
