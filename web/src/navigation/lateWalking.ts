// The controller of the WALK type, in a module of its own (document/parts.ts).

import { LateModule } from "../document/lateModule.ts";
import type { WalkController } from "./walkController.ts";

export const lateWalkController = new LateModule<() => WalkController>("walking");
