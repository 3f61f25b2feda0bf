// The way of images and arrays to the GPU: images are decoded by the browser
// beside the main thread; both are uploaded in pieces before frames, and kept
// nowhere else.

import type { ElementArray } from "../stage/vertexArray.ts";
import type { DataImage } from "../decode/image.ts";
import type { DecodedImage } from "../stage/decodedImage.ts";
import { decodePicture } from "../decode/picture.ts";
import { decodeImage, decodeWithBrowser } from "../decode/image.ts";
import type { ArrayUse, StoredBytes } from "../stage/stage.ts";
import type { Picture } from "../delivery/resourcePool.ts";
import type { SamplingDescription } from "../document/description.ts";
import { beforeNextFrame } from "../render/frames/nextFrame.ts";
import type { SceneRenderer } from "../render/sceneRenderer.ts";
import type { Steps } from "../scheduler/frameTaskQueue.ts";
import { FrameTaskQueue } from "../scheduler/frameTaskQueue.ts";

/** 240 MB in a second of 60 frames; the time leaves most of a frame to drawing. */
const bytesPerFrame = 4 * 2 ** 20;
const millisecondsPerFrame = 4;

export class UploadPipeline {
  readonly #renderer: SceneRenderer;
  readonly #work = new FrameTaskQueue({
    bytesPerFrame,
    millisecondsPerFrame,
    now: () => performance.now(),
    // Where there is no picture yet there is none to hold up.
    requestFrame: (callback) => {
      if (this.#renderer.isEmpty) setTimeout(callback);
      else beforeNextFrame(callback);
    },
  });

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

  /** The same of a picture, in any format that the browser knows; its first row is the lowest, as texture coordinates count. */
  async makePicture(
    bytes: Uint8Array<ArrayBuffer>,
    sampling: SamplingDescription,
    signal: AbortSignal,
  ): Promise<Picture> {
    const { bitmap, hasAlpha } = await decodePicture(bytes, this.#renderer.largestTexture, sampling);
    try {
      signal.throwIfAborted();
      return { image: await this.#upload(bitmap, signal, sampling), hasAlpha };
    } finally {
      bitmap.close();
    }
  }

  /** Rejects with the signal's reason; nothing is then left behind. */
  async storeBytes(array: ElementArray, use: ArrayUse, signal: AbortSignal): Promise<StoredBytes> {
    const { bytes, steps } = this.#renderer.beginStoring(array, use);
    await this.#finish(steps, bytes, signal);
    return bytes;
  }

  async #upload(bitmap: ImageBitmap, signal: AbortSignal, sampling?: SamplingDescription): Promise<DecodedImage> {
    const { image, steps } = this.#renderer.beginUpload(bitmap, sampling);
    await this.#finish(steps, image, signal);
    return image;
  }

  async #finish(steps: Steps, what: { close(): void }, signal: AbortSignal): Promise<void> {
    try {
      await this.#work.run(steps, signal);
    } catch (error) {
      what.close();
      throw error;
    }
  }
}
