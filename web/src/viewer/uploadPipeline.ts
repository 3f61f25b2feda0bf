// Uploads images and arrays to the GPU. The browser decodes images outside of the main
// thread; both are uploaded in pieces before frames, and kept nowhere else.

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

/** Limits of one frame: 240 MB a second at 60 frames, and time that leaves most of a frame to drawing. */
const bytesPerFrame = 4 * 2 ** 20;
const millisecondsPerFrame = 4;

export class UploadPipeline {
  readonly #renderer: SceneRenderer;
  readonly #work = new FrameTaskQueue({
    bytesPerFrame,
    millisecondsPerFrame,
    now: () => performance.now(),
    // Without a picture there are no frames that uploads could delay.
    requestFrame: (callback) => {
      if (this.#renderer.isEmpty) setTimeout(callback);
      else beforeNextFrame(callback);
    },
  });

  constructor(renderer: SceneRenderer) {
    this.#renderer = renderer;
  }

  /** Decodes and uploads an image of vertex data. Rejects with DecodeError, or with the signal's reason; nothing is then left on the GPU. */
  async makeImage(png: Uint8Array<ArrayBuffer>, signal: AbortSignal): Promise<DataImage> {
    const { image: bitmap, channels } = await decodeImage(png, decodeWithBrowser, this.#renderer.maxTextureSize);
    try {
      signal.throwIfAborted();
      return { image: await this.#upload(bitmap, signal), channels };
    } finally {
      bitmap.close();
    }
  }

  /** Decodes and uploads a texture in any format that the browser knows. Its first row is the lowest, as in texture coordinates. */
  async makePicture(
    bytes: Uint8Array<ArrayBuffer>,
    sampling: SamplingDescription,
    signal: AbortSignal,
  ): Promise<Picture> {
    const { bitmap, hasAlpha } = await decodePicture(bytes, this.#renderer.maxTextureSize, sampling);
    try {
      signal.throwIfAborted();
      return { image: await this.#upload(bitmap, signal, sampling), hasAlpha };
    } finally {
      bitmap.close();
    }
  }

  /** Uploads an array. Rejects with the signal's reason; nothing is then left on the GPU. */
  async storeBytes(array: ElementArray, use: ArrayUse, signal: AbortSignal): Promise<StoredBytes> {
    const { bytes, steps } = this.#renderer.beginBufferUpload(array, use);
    await this.#finish(steps, bytes, signal);
    return bytes;
  }

  async #upload(bitmap: ImageBitmap, signal: AbortSignal, sampling?: SamplingDescription): Promise<DecodedImage> {
    const { image, steps } = this.#renderer.beginTextureUpload(bitmap, sampling);
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
