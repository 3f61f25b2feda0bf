// Uploads images and arrays to the GPU. The browser decodes images outside of the main
// thread. Images and arrays are uploaded in pieces before frames. JavaScript keeps no copy, except
// of small arrays (render/uploads/bufferStore.ts) and of those that replace others.

import type { ElementArray } from "../stage/vertexArray.ts";
import type { DataImage } from "../decode/image.ts";
import type { DecodedImage } from "../stage/decodedImage.ts";
import type { RunJob } from "../decode/jobs.ts";
import type { TexelArray, TextureFile } from "../decode/textureImage.ts";
import { decodeTextureImage } from "../decode/textureImage.ts";
import type { ArrayUse, GpuArray } from "../stage/stage.ts";
import type { TextureImage } from "../delivery/content.ts";
import { lateDataImages } from "../delivery/lateDataImages.ts";
import type { SamplingDescription } from "../document/description.ts";
import { beforeNextFrame } from "../render/frames/nextFrame.ts";
import type { SceneRenderer } from "../render/sceneRenderer.ts";
import type { Steps } from "../scheduler/frameTaskQueue.ts";
import { FrameTaskQueue, uploadBytesPerFrame } from "../scheduler/frameTaskQueue.ts";

/** Leaves most of a frame's 16 ms to drawing. */
const uploadMillisecondsPerFrame = 4;

export class UploadPipeline {
  readonly #renderer: SceneRenderer;
  readonly #runJob: RunJob;
  readonly #queue = new FrameTaskQueue({
    bytesPerFrame: uploadBytesPerFrame,
    millisecondsPerFrame: uploadMillisecondsPerFrame,
    now: () => performance.now(),
    // An empty scene is not animated: there are no frames that uploads could delay.
    requestFrame: (callback) => {
      if (this.#renderer.isEmpty) setTimeout(callback);
      else beforeNextFrame(callback);
    },
  });

  constructor(renderer: SceneRenderer, runJob: RunJob) {
    this.#renderer = renderer;
    this.#runJob = runJob;
  }

  /**
   * Decodes and uploads an image of vertex data. Rejects with DecodeError, or with the signal's reason; nothing is then
   * left on the GPU.
   */
  async makeImage(png: Uint8Array<ArrayBuffer>, signal: AbortSignal): Promise<DataImage> {
    const { image: bitmap, channels } = await lateDataImages.required.decode(
      png,
      this.#renderer.uploads.maxTextureSize,
    );
    return { image: await this.#upload(bitmap, signal), channels };
  }

  /**
   * Decodes and uploads a texture in any format that the browser knows. Its first row is the lowest, as in texture
   * coordinates.
   */
  async makeTextureImage(file: TextureFile, sampling: SamplingDescription, signal: AbortSignal): Promise<TextureImage> {
    const maxEdge = this.#renderer.uploads.maxTextureSize;
    const decoding = { ...sampling, maxEdge, runJob: this.#runJob, signal };
    const { bitmap, hasAlpha } = await decodeTextureImage(file, decoding);
    return { image: await this.#upload(bitmap, signal, sampling), hasAlpha };
  }

  /** Uploads an array. Rejects with the signal's reason; nothing is then left on the GPU. */
  async storeBytes(array: ElementArray, use: ArrayUse, signal: AbortSignal): Promise<GpuArray> {
    const { bytes, steps } = this.#renderer.uploads.beginBuffer(array, use);
    await this.#finish(steps, bytes, signal);
    return bytes;
  }

  async #upload(
    bitmap: ImageBitmap | TexelArray,
    signal: AbortSignal,
    sampling?: SamplingDescription,
  ): Promise<DecodedImage> {
    if (signal.aborted) bitmap.close();
    signal.throwIfAborted();
    const { image, steps } = this.#renderer.uploads.beginTexture(bitmap, sampling);
    await this.#finish(steps, image, signal);
    return image;
  }

  async #finish(steps: Steps, resource: { close(): void }, signal: AbortSignal): Promise<void> {
    try {
      await this.#queue.run(steps, signal);
    } catch (error) {
      resource.close();
      throw error;
    }
  }
}
