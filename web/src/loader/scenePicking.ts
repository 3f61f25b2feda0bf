// What lies under a pixel of somebody's own app: the GPU is asked, as no vertices
// are kept that a ray could be held against. The app's renderer is lent, and given
// back as it was.

import type { Object3D, PerspectiveCamera, WebGLRenderer } from "three";
import { Color, Vector2, type Vector3 } from "three";
import type { PickCandidate } from "../render/picking/picker.ts";
import { Picker } from "../render/picking/picker.ts";

/** The names are those of three's Intersection, where it has them. */
export interface SceneHit {
  /** The shape's group, named by its DEF. */
  readonly object: Object3D;
  /** In the app's world, as `normal`. */
  readonly point: Vector3;
  /** Of length 1, as it is shaded; undefined for points and lines without normals. */
  readonly normal: Vector3 | undefined;
  readonly distance: number;
  /** Of the geometry's patches. */
  readonly patch: number;
  /** Of the patch's triangles; undefined for points and lines. */
  readonly triangle: number | undefined;
  /** Of the patch's vertices, the one of the triangle that is nearest. */
  readonly vertex: number;
}

export class ScenePicker {
  #lent: { readonly renderer: WebGLRenderer; readonly picker: Picker } | undefined;

  /** At CSS pixels from the top left of the renderer's canvas; points and lines are at most `largestWidth` of them wide. Waits for the GPU. */
  pick(
    renderer: WebGLRenderer,
    camera: PerspectiveCamera,
    { x, y }: { readonly x: number; readonly y: number },
    largestWidth: number,
    candidates: Iterable<PickCandidate>,
  ): SceneHit | undefined {
    if (this.#lent?.renderer !== renderer) {
      this.dispose();
      this.#lent = { renderer, picker: new Picker(renderer) };
    }
    const { picker } = this.#lent;
    const ratio = renderer.getPixelRatio();
    const { x: width, y: height } = renderer.getDrawingBufferSize(new Vector2());
    const place = { x: Math.floor(x * ratio), y: Math.floor(y * ratio), width, height };
    if (place.x < 0 || place.y < 0 || place.x >= width || place.y >= height) return undefined;
    const slack = 1 + Math.ceil((largestWidth * ratio) / 2);
    const hit = lend(renderer, () => picker.pick(camera, place, slack, candidates));
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
    this.#lent?.picker.dispose();
    this.#lent = undefined;
  }
}

/** An app's renderer may clear to any colour, or not at all, and draw elsewhere than on the screen. */
function lend<Result>(renderer: WebGLRenderer, use: () => Result): Result {
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
