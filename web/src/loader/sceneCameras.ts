// The cameras of an app that levels of detail follow: those of one task, the last that named any.

import type { Camera, Object3D, WebGLRenderer } from "three";
import { ArrayCamera, Matrix4, Vector2, Vector3 } from "three";
import type { SceneView } from "../levels/levelViews.ts";
import { planesOf } from "../scheduler/viewMetrics.ts";

/** A view, and the numbers that it depends on. */
interface SeenView extends SceneView {
  readonly key: readonly number[];
}

export class SceneCameras {
  readonly #onChange: () => void;
  #views: readonly SeenView[] = [];
  /** Those of the present task. */
  #next: SeenView[] | undefined;

  /** `onChange`: the views differ from those before; called in a microtask. */
  constructor(onChange: () => void) {
    this.#onChange = onChange;
  }

  /** Empty before the first camera. */
  get views(): readonly SceneView[] {
    return this.#views;
  }

  /** Adds a camera that draws the scene into the renderer's canvas, or the cameras of its XR session. */
  add(camera: Camera, renderer: WebGLRenderer, scene: Object3D): void {
    if (this.#next === undefined) {
      this.#next = [];
      queueMicrotask(() => {
        this.#follow();
      });
    }
    const seen = renderer.xr.isPresenting ? renderer.xr.getCamera() : camera;
    const { height } = renderer.getDrawingBufferSize(new Vector2());
    const cameras = seen instanceof ArrayCamera ? seen.cameras : [seen];
    scene.updateWorldMatrix(true, false);
    // Cameras of an array have their own viewports, and world matrices that the session has set.
    if (cameras[0] === seen) seen.updateWorldMatrix(true, false);
    for (const each of cameras) {
      const view = viewOf(each, "viewport" in each ? each.viewport.w : height, scene.matrixWorld);
      if (view) this.#next.push(view);
    }
  }

  #follow(): void {
    const next = this.#next ?? [];
    this.#next = undefined;
    const isSame =
      next.length === this.#views.length &&
      next.every(({ key }, n) => key.every((value, i) => value === this.#views[n]?.key[i]));
    if (isSame) return;
    this.#views = next;
    this.#onChange();
  }
}

/** Undefined for a camera of a canvas without area, and for one of numbers that are not finite. */
function viewOf(camera: Camera, height: number, worldFromScene: Matrix4): SeenView | undefined {
  const { matrixWorld, projectionMatrix } = camera;
  const clipFromWorld = new Matrix4().multiplyMatrices(projectionMatrix, matrixWorld.clone().invert());
  const pixelsPerUnit = (projectionMatrix.elements[5] * height) / 2;
  const near = "near" in camera && typeof camera.near === "number" ? Math.max(camera.near, 1e-6) : 1e-6;
  const key = [...clipFromWorld.elements, ...worldFromScene.elements, pixelsPerUnit, near];
  if (!key.every(Number.isFinite) || pixelsPerUnit <= 0) return undefined;
  return {
    camera: {
      position: new Vector3().setFromMatrixPosition(matrixWorld).toArray(),
      planes: planesOf(clipFromWorld.elements),
      pixelsPerUnit,
      near,
    },
    isOrthographic: projectionMatrix.elements[11] === 0,
    worldFromScene: [...worldFromScene.elements],
    key,
  };
}
