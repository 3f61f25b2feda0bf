// The part "walking": the navigation type WALK.

import { lateWalkController } from "../../navigation/lateWalking.ts";
import { WalkController } from "../../navigation/walkController.ts";
import { DepthProbe } from "../../render/picking/depthProbe.ts";
import { lateDepthProbe } from "../../render/picking/lateDepthProbe.ts";

export function add(): void {
  lateWalkController.add(() => new WalkController());
  lateDepthProbe.add((renderer) => new DepthProbe(renderer));
}
