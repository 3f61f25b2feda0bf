// The depth probe, in the module of walking (document/parts.ts).

import type { WebGLRenderer } from "three";
import type { DepthProbe } from "./depthProbe.ts";

let make: ((renderer: WebGLRenderer) => DepthProbe) | undefined;

export function addDepthProbe(added: (renderer: WebGLRenderer) => DepthProbe): void {
  make = added;
}

/** Undefined before the module has been loaded. */
export function makeDepthProbe(renderer: WebGLRenderer): DepthProbe | undefined {
  return make?.(renderer);
}
