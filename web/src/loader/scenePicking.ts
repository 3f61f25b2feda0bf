// Picking in an app's own three.js scene: the GPU draws the pixel, since a Raycaster would
// need vertices in JavaScript. Draws with the app's renderer, and restores its state.

import type { Object3D, PerspectiveCamera, WebGLRenderer } from "three";
import { Color, Vector2, type Vector3 } from "three";
import type { PickCandidate } from "../render/picking/picker.ts";
import { Picker } from "../render/picking/picker.ts";

/** A picked point. Fields that three.js' Intersection has too are named as there. */
export interface SceneHit {
  /** The shape's group, named by its DEF. */
  readonly object: Object3D;
  /** In world coordinates, as `normal`. */
  readonly point: Vector3;
  /** The unit normal as shaded; undefined for points and lines without normals. */
  readonly normal: Vector3 | undefined;
  readonly distance: number;
  /** Index of the geometry's patch. */
  readonly patch: number;
  /** Index of the patch's triangle; undefined for points and lines. */
  readonly triangle: number | undefined;
  /** Index of the patch's vertex that is nearest to the hit. */
  readonly vertex: number;
}

export class ScenePicker {
  /** The picker of the renderer that was used last. */
  #current: { readonly renderer: WebGLRenderer; readonly picker: Picker } | undefined;

  /**
   * Picks at CSS pixels from the top left of the renderer's canvas; points and lines are at most `maxWidth` CSS pixels
   * wide. Waits for the GPU.
   */
  pick(
    renderer: WebGLRenderer,
    camera: PerspectiveCamera,
    { x, y }: { readonly x: number; readonly y: number },
    maxWidth: number,
    candidates: Iterable<PickCandidate>,
  ): SceneHit | undefined {
    if (this.#current?.renderer !== renderer) {
      this.dispose();
      this.#current = { renderer, picker: new Picker(renderer) };
    }
    const { picker } = this.#current;
    const ratio = renderer.getPixelRatio();
    const { x: width, y: height } = renderer.getDrawingBufferSize(new Vector2());
    const pixel = { x: Math.floor(x * ratio), y: Math.floor(y * ratio), width, height };
    if (pixel.x < 0 || pixel.y < 0 || pixel.x >= width || pixel.y >= height) return undefined;
    const slack = 1 + Math.ceil((maxWidth * ratio) / 2);
    const hit = withPickingState(renderer, () => picker.pick(camera, pixel, slack, candidates));
    if (hit === undefined) return undefined;
    const { group, position, normal, patch, triangle, vertex } = hit;
    return {
      object: group,
      point: position,
      normal,
      patch,
      triangle,
      vertex,
      distance: position.distanceTo(camera.getWorldPosition(position.clone())),
    };
  }

  dispose(): void {
    this.#current?.picker.dispose();
    this.#current = undefined;
  }
}

/** Calls `use` with the renderer's state that picking needs, and restores the app's state. */
function withPickingState<Result>(renderer: WebGLRenderer, use: () => Result): Result {
  const target = renderer.getRenderTarget();
  const [face, level] = [renderer.getActiveCubeFace(), renderer.getActiveMipmapLevel()];
  const color = renderer.getClearColor(new Color());
  const alpha = renderer.getClearAlpha();
  const { autoClear, autoClearColor, autoClearDepth } = renderer;
  const { enabled } = renderer.xr;
  renderer.setClearColor(0x000000, 0);
  Object.assign(renderer, { autoClear: true, autoClearColor: true, autoClearDepth: true });
  renderer.xr.enabled = false;
  try {
    return use();
  } finally {
    renderer.xr.enabled = enabled;
    Object.assign(renderer, { autoClear, autoClearColor, autoClearDepth });
    renderer.setClearColor(color, alpha);
    renderer.setRenderTarget(target, face, level);
  }
}
