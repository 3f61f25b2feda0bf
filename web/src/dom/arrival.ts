// The way of an image from its file to the GPU: decoded by the browser beside
// the main thread, uploaded in strips before frames, and kept nowhere else.

import type { DataImage, DecodedImage } from "../decode/image.ts";
import { decodeImage, decodeWithBrowser } from "../decode/image.ts";
import type { SceneRenderer } from "../render/sceneRenderer.ts";
import { FrameWork } from "../scheduler/frameWork.ts";

/** 240 MB in a second of 60 frames; the time leaves most of a frame to drawing. */
const bytesPerFrame = 4 * 2 ** 20;
const millisecondsPerFrame = 4;

/** In a page that nobody sees there are no frames, but files come. */
const framelessMs = 250;

export class Arrival {
  readonly #renderer: SceneRenderer;
  readonly #work = new FrameWork({ bytesPerFrame, millisecondsPerFrame, now: () => performance.now(), requestFrame: beforeNextFrame });

  constructor(renderer: SceneRenderer) {
    this.#renderer = renderer;
  }

  /** Rejects with DecodeError, or with the signal's reason; nothing is then left behind. */
  async makeImage(png: Uint8Array<ArrayBuffer>, signal: AbortSignal): Promise<DataImage> {
    const { image: bitmap, channels } = await decodeImage(png, decodeWithBrowser, this.#renderer.largestTexture);
    try {
      signal.throwIfAborted();
      return { image: await this.#upload(bitmap, signal), channels };
    } finally {
      bitmap.close();
    }
  }

  async #upload(bitmap: ImageBitmap, signal: AbortSignal): Promise<DecodedImage> {
    const { image, steps } = this.#renderer.beginUpload(bitmap);
    try {
      await this.#work.run(steps, signal);
      return image;
    } catch (error) {
      image.close();
      throw error;
    }
  }
}

function beforeNextFrame(callback: (isUnseen: boolean) => void): void {
  const call = (isUnseen: boolean) => {
    cancelAnimationFrame(frame);
    clearTimeout(timer);
    callback(isUnseen);
  };
  const frame = requestAnimationFrame(() => { call(false); });
  const timer = setTimeout(() => { call(document.hidden); }, framelessMs);
}
