// Picking in the last frame. Repeated blocking picks of one pixel of one frame are answered from a
// cache: a click asks for what pointerdown has found.

import type { PerspectiveCamera, WebGLRenderer } from "three";
import type { Hit, PickCandidate, PixelPosition } from "./picker.ts";
import { Picker } from "./picker.ts";

export class ScreenPicker {
  readonly #picker: Picker;
  readonly #camera: PerspectiveCamera;
  readonly #candidates: () => Iterable<PickCandidate>;
  /** The last result, until the scene changes. */
  #found: { readonly x: number; readonly y: number; readonly hit: Hit | undefined } | undefined;

  /** `camera`: that of the last frame. */
  constructor(renderer: WebGLRenderer, camera: PerspectiveCamera, candidates: () => Iterable<PickCandidate>) {
    this.#picker = new Picker(renderer);
    this.#camera = camera;
    this.#candidates = candidates;
  }

  /**
   * Blocks until the GPU is done. `slack`: how far, in device pixels, a vertex may be from the pixels that it covers.
   */
  pick(pixel: PixelPosition, slack: number): Hit | undefined {
    if (!isInside(pixel)) return undefined;
    const { x, y } = pixel;
    if (this.#found?.x !== x || this.#found.y !== y) {
      this.#found = { x, y, hit: this.#picker.pick(this.#camera, pixel, slack, this.#candidates()) };
    }
    return this.#found.hit;
  }

  /**
   * The same without blocking. `positionNow` is asked again after a stale result, as the picture may have been resized.
   */
  async pickAsync(positionNow: () => PixelPosition, slack: number): Promise<Hit | undefined> {
    for (let pixel = positionNow(); isInside(pixel); pixel = positionNow()) {
      const hit = await this.#picker.pickAsync(this.#camera, pixel, slack, this.#candidates());
      if (hit !== "stale") return hit;
    }
    return undefined;
  }

  /** Call when the next frame may differ. */
  forget(): void {
    this.#found = undefined;
  }

  dispose(): void {
    this.#picker.dispose();
  }
}

function isInside({ x, y, width, height }: PixelPosition): boolean {
  return x >= 0 && y >= 0 && x < width && y < height;
}
