// Loads the part of the runtime for walking when the user chooses WALK. Scenes that begin with it need the part from
// the beginning.

import type { NavigationDescription } from "../document/description.ts";
import type { CameraController } from "../navigation/cameraController.ts";
import { navigationTypesOf } from "../navigation/navigationType.ts";
import type { LatePart } from "../viewer/parts/latePart.ts";

export function beginsWithWalk({ type }: NavigationDescription): boolean {
  return navigationTypesOf(type).first === "walk";
}

/**
 * Call when the navigation type has changed. `onLoaded`: the camera walks from now on, as keys and pointers have asked
 * for meanwhile. After an error, the next change to WALK tries again.
 */
export function followNavigationType(
  { type }: Pick<CameraController, "type">,
  part: LatePart,
  log: { readonly error: (sentence: string) => void },
  onLoaded: () => void,
): void {
  if (type !== "walk" || part.module !== undefined) return;
  part.load().then(onLoaded, (error: unknown) => {
    log.error(`the module for walking could not be loaded: ${String(error)}`);
  });
}
