// What the last frame shows at a pixel. Who asks twice for the same pixel of the
// same frame is answered from memory: a click asks for what pointerdown has found.

import type { PerspectiveCamera, WebGLRenderer } from "three";
import type { Hit, PickCandidate, PixelPosition } from "./picker.ts";
import { Picker } from "./picker.ts";

export class ScreenPicker {
  readonly #picker: Picker;
  readonly #camera: PerspectiveCamera;
  readonly #candidates: () => Iterable<PickCandidate>;
  /** What has been found since the scene last changed. */
  #found: { readonly x: number; readonly y: number; readonly hit: Hit | undefined } | undefined;

  /** `camera` stands as it did for the last frame. */
  constructor(renderer: WebGLRenderer, camera: PerspectiveCamera, candidates: () => Iterable<PickCandidate>) {
    this.#picker = new Picker(renderer);
    this.#camera = camera;
    this.#candidates = candidates;
  }

  /** `slack`: how far, in device pixels, a vertex may be from what it covers. Waits for the GPU. */
  pick(place: PixelPosition, slack: number): Hit | undefined {
    if (!isInside(place)) return undefined;
    const { x, y } = place;
    if (this.#found?.x !== x || this.#found.y !== y) {
      this.#found = { x, y, hit: this.#picker.pick(this.#camera, place, slack, this.#candidates()) };
    }
    return this.#found.hit;
  }

  /** The same without waiting; the picture may become larger or smaller meanwhile. */
  async pickAsync(placeNow: () => PixelPosition, slack: number): Promise<Hit | undefined> {
    for (let place = placeNow(); isInside(place); place = placeNow()) {
      const hit = await this.#picker.pickAsync(this.#camera, place, slack, this.#candidates());
      if (hit !== "stale") return hit;
    }
    return undefined;
  }

  /** The next frame shows something else. */
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
