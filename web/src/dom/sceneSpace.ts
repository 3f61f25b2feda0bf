// Where the viewer, the pointer and the Transforms of a page's scene are, for its sensors.

import type { SceneView } from "../animation/page/pageAnimation.ts";
import type { PointerSpace } from "../animation/page/pointerSensing.ts";
import type { CameraController } from "../navigation/cameraController.ts";
import type { SceneRenderer } from "../render/sceneRenderer.ts";

const identity: readonly number[] = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

export interface SceneSpace extends PointerSpace {
  /** The viewer in scene coordinates; undefined while the canvas has no area. */
  view(): SceneView | undefined;
}

/** `inlineOf`: the Inline, the first one, of a document with this root. */
export function sceneSpaceOf(
  x3d: Element,
  canvas: HTMLCanvasElement,
  renderer: SceneRenderer,
  cameraController: CameraController,
  inlineOf: (root: Element) => Element | undefined,
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
        at = at.parentElement ?? inlineOf(at);
      }
      return identity;
    },
  };
}
