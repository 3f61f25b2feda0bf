// Picks in the last frame. The result of a blocking pick is kept until the next frame, since a click
// picks the pixel that its pointerdown has picked.

import type { PerspectiveCamera, WebGLRenderer } from "three";
import type { Hit, PickCandidate, PixelPosition } from "./picker.ts";
import { Picker } from "./picker.ts";

export class ScreenPicker {
  readonly #picker: Picker;
  readonly #camera: PerspectiveCamera;
  readonly #candidates: () => Iterable<PickCandidate>;
  /** The last blocking pick, until the next frame may differ. */
  #lastPick: { readonly x: number; readonly y: number; readonly hit: Hit | undefined } | undefined;

  /** `camera` is the camera of the last frame. */
  constructor(renderer: WebGLRenderer, camera: PerspectiveCamera, candidates: () => Iterable<PickCandidate>) {
    this.#picker = new Picker(renderer);
    this.#camera = camera;
    this.#candidates = candidates;
  }

  /**
   * The hit at a pixel. Blocks until the GPU is done. `slack` is the maximum distance in device pixels between a vertex
   * and a pixel that its point or line covers.
   */
  pick(pixel: PixelPosition, slack: number): Hit | undefined {
    if (!isInside(pixel)) return undefined;
    const { x, y } = pixel;
    if (this.#lastPick?.x !== x || this.#lastPick.y !== y) {
      this.#lastPick = { x, y, hit: this.#picker.pick(this.#camera, pixel, slack, this.#candidates()) };
    }
    return this.#lastPick.hit;
  }

  /**
   * The hit at a pixel, without blocking. `currentPixel` is called again after a stale result, as the canvas may have
   * been resized.
   */
  async pickAsync(currentPixel: () => PixelPosition, slack: number): Promise<Hit | undefined> {
    for (let pixel = currentPixel(); isInside(pixel); pixel = currentPixel()) {
      const hit = await this.#picker.pickAsync(this.#camera, pixel, slack, this.#candidates());
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
}

function isInside({ x, y, width, height }: PixelPosition): boolean {
  return x >= 0 && y >= 0 && x < width && y < height;
}
