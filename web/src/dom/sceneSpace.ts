// Where the viewer, the pointer and the Transforms of a page's scene are, for its sensors.

import type { SceneView } from "../animation/page/pageAnimation.ts";
import type { PointerSpace } from "../animation/page/pointerSensing.ts";
import type { InliningCore } from "./inlinedRoots.ts";
import { loadedInlines } from "./inlinedRoots.ts";
import type { PageView } from "./pageView.ts";

const identity: readonly number[] = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

export interface SceneSpace extends PointerSpace {
  /** The viewer in scene coordinates; undefined while the canvas has no area. */
  view(): SceneView | undefined;
}

export function sceneSpaceOf(
  { x3d, canvas, renderer, cameraController }: Pick<PageView, "x3d" | "canvas" | "renderer" | "cameraController">,
  core: InliningCore,
): SceneSpace {
  return {
    pointerTarget: x3d,
    view() {
      const { view } = renderer;
      if (view === undefined) return undefined;
      const { orientation, center } = cameraController.pose;
      const { x, y, z, w } = orientation;
      return {
        position: view.position,
        orientation: [x, y, z, w],
        centerOfRotation: center.toArray(),
        clipFromScene: view.clipFromScene,
      };
    },
    rayAt(clientX, clientY) {
      const { left, top, width, height } = canvas.getBoundingClientRect();
      if (!(width > 0 && height > 0)) return undefined;
      return renderer.camera.rayAt((2 * (clientX - left)) / width - 1, 1 - (2 * (clientY - top)) / height);
    },
    sceneFromChildrenOf(element) {
      let at: Element | null | undefined = element as unknown as Element;
      while (at && at !== x3d) {
        const matrix = renderer.scene.shapes.sceneFromTransform(at);
        if (matrix) return matrix.elements;
        at = at.parentElement ?? inlineOf(core, at);
      }
      return identity;
    },
  };
}

/** The first Inline of the document with this root. */
function inlineOf(core: InliningCore, root: Element): Element | undefined {
  return loadedInlines(core).find(([, each]) => each === root)?.[0];
}
