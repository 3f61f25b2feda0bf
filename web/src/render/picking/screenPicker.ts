// Picks in the last frame. The result of a blocking pick is kept until the next frame, since a click
// picks the pixel that its pointerdown has picked.

import type { WebGLRenderer } from "three";
import type { ViewCamera } from "../frames/viewCamera.ts";
import { defaultPointSize } from "../stages/stageUniforms.ts";
import type { Hit, PickCandidate, PixelPosition } from "./picker.ts";
import { Picker } from "./picker.ts";

export interface PickedShapes {
  /** Maximum width of points and lines in CSS pixels; 0 if no shape sets one. */
  readonly maxWidth: number;
  pickCandidates(): Iterable<PickCandidate>;
}

export class ScreenPicker {
  readonly #picker: Picker;
  readonly #camera: Pick<ViewCamera, "drawn" | "isDrawn" | "size" | "pixelRatio">;
  readonly #shapes: PickedShapes;
  /** The last blocking pick, until the next frame may differ. */
  #lastPick: { readonly x: number; readonly y: number; readonly hit: Hit | undefined } | undefined;

  constructor(
    renderer: WebGLRenderer,
    camera: Pick<ViewCamera, "drawn" | "isDrawn" | "size" | "pixelRatio">,
    shapes: PickedShapes,
  ) {
    this.#picker = new Picker(renderer);
    this.#camera = camera;
    this.#shapes = shapes;
  }

  /**
   * The hit at a pixel of the canvas' buffer, from its top left; in an inlined document its element is the Inline.
   * Blocks until the GPU is done.
   */
  pick(x: number, y: number): Hit | undefined {
    const pixel = this.#pixelAt(x, y);
    if (pixel === undefined) return undefined;
    if (this.#lastPick?.x !== x || this.#lastPick.y !== y) {
      const hit = this.#picker.pick(this.#camera.drawn, pixel, this.#slack, this.#shapes.pickCandidates());
      this.#lastPick = { x, y, hit };
    }
    return this.#lastPick.hit;
  }

  /** Picks without blocking or delaying a frame. */
  async pickAsync(x: number, y: number): Promise<Hit | undefined> {
    // Again after a stale result, as the canvas may have been resized.
    for (let pixel = this.#pixelAt(x, y); pixel !== undefined; pixel = this.#pixelAt(x, y)) {
      const candidates = this.#shapes.pickCandidates();
      const hit = await this.#picker.pickAsync(this.#camera.drawn, pixel, this.#slack, candidates);
      if (hit !== "stale") return hit;
    }
    return undefined;
  }

  /** Call when the next frame may differ. */
  forget(): void {
    this.#lastPick = undefined;
  }

  dispose(): void {
    this.#picker.dispose();
  }

  /** Undefined outside of the last frame. */
  #pixelAt(x: number, y: number): PixelPosition | undefined {
    const { isDrawn, size } = this.#camera;
    return isDrawn && x >= 0 && y >= 0 && x < size.width && y < size.height ? { ...size, x, y } : undefined;
  }

  /** How far, in device pixels, a vertex may be from the pixels that its point or line covers. */
  get #slack(): number {
    const largest = Math.max(this.#shapes.maxWidth, defaultPointSize);
    return 1 + Math.ceil((largest * this.#camera.pixelRatio.value) / 2);
  }
}
