// The controller of the WALK type, in a module of its own (document/parts.ts).

import type { WalkController } from "./walkController.ts";

let make: (() => WalkController) | undefined;

/** Undefined in tests of what happens before. */
export function addWalkController(added: (() => WalkController) | undefined): void {
  make = added;
}

/** Undefined before the module has been loaded. */
export function makeWalkController(): WalkController | undefined {
  return make?.();
}
