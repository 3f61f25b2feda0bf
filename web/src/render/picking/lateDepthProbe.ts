// The depth probe, in the module of walking (document/parts.ts).

import type { WebGLRenderer } from "three";
import { LateModule } from "../../document/lateModule.ts";
import type { DepthProbe } from "./depthProbe.ts";

export const lateDepthProbe = new LateModule<(renderer: WebGLRenderer) => DepthProbe>("walking");
