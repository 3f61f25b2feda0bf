// Images of vertex data, and textures, for three.js apps. They keep their bitmaps, as three.js' own
// textures do, so that any renderer can upload them, and restored contexts get them back.

import { NoColorSpace, SRGBColorSpace, Texture } from "three";
import type { DataImage } from "../decode/image.ts";
import type { DecodedImage, WritableImage } from "../stage/decodedImage.ts";
import { decodeDataImage } from "../decode/image.ts";
import { decodeAlphaImage } from "../decode/alphaImage.ts";
import type { RunJob } from "../decode/jobs.ts";
import type { TexelArray, TextureFile } from "../decode/textureImage.ts";
import { decodeTextureImage, setAlphaImages } from "../decode/textureImage.ts";
import { bytesPerTexel } from "../delivery/patchFiles.ts";
import type { TextureImage } from "../delivery/content.ts";
import type { SamplingDescription } from "../document/description.ts";
import { emptyTexture, textureFrom, writeTexels } from "../render/uploads/textureStore.ts";
import type { TextureProvider } from "../render/uploads/textureProvider.ts";
import { setSampling } from "../render/uploads/textureSampling.ts";
import { setDataSampling } from "../render/uploads/textureSampling.ts";
import type { UploadThrottle } from "./uploadThrottle.ts";

/**
 * Maximum width and height in texels: the limit must be known before there is a renderer, and every renderer in use
 * supports 4096.
 */
export const maxTextureSize = 4096;

export class BitmapTextures implements TextureProvider {
  readonly #uploadThrottle: UploadThrottle;
  readonly #runJob: RunJob;
  readonly #textures = new WeakMap<DecodedImage, Texture>();

  constructor(uploadThrottle: UploadThrottle, runJob: RunJob) {
    this.#uploadThrottle = uploadThrottle;
    this.#runJob = runJob;
    setAlphaImages({ load: () => Promise.resolve({ decodeAlphaImage }) });
  }

  textureOf(image: DecodedImage): Texture {
    const texture = this.#textures.get(image);
    if (texture === undefined) throw new RangeError("the image is closed");
    return texture;
  }

  /**
   * Decodes an image of vertex data. Rejects with DecodeError, or with the signal's reason; nothing is then left in
   * memory.
   */
  async makeImage(png: Uint8Array<ArrayBuffer>, signal: AbortSignal): Promise<DataImage> {
    const { image: bitmap, channels } = await decodeDataImage(png, maxTextureSize);
    return { image: await this.#store(bitmap, dataTextureOf(bitmap), signal), channels };
  }

  /** Makes an image of vertex data whose texels can be replaced. */
  makeWritableImage(width: number, height: number): WritableImage {
    const texture = emptyTexture(width, height);
    const image = {
      width,
      height,
      close: () => {
        if (this.#textures.delete(image)) texture.dispose();
      },
    };
    this.#textures.set(image, texture);
    return {
      image,
      write: (texels) => {
        writeTexels(texture, texels);
      },
    };
  }

  /** Decodes a texture of an appearance. Rejects as `makeImage` does. */
  async makeTextureImage(file: TextureFile, sampling: SamplingDescription, signal: AbortSignal): Promise<TextureImage> {
    const decoding = { ...sampling, maxEdge: maxTextureSize, runJob: this.#runJob, signal };
    const { bitmap, hasAlpha } = await decodeTextureImage(file, decoding);
    const texture = textureFrom(bitmap);
    texture.flipY = false; // the bitmap has been flipped
    texture.colorSpace = sampling.isData ? NoColorSpace : SRGBColorSpace;
    setSampling(texture, sampling);
    texture.needsUpdate = true;
    return { image: await this.#store(bitmap, texture, signal), hasAlpha };
  }

  async #store(bitmap: ImageBitmap | TexelArray, texture: Texture, signal: AbortSignal): Promise<DecodedImage> {
    try {
      await this.#uploadThrottle.waitForFrame(bitmap.width * bitmap.height * bytesPerTexel, signal);
      signal.throwIfAborted();
    } catch (error) {
      bitmap.close();
      throw error;
    }
    const image = {
      width: bitmap.width,
      height: bitmap.height,
      close: () => {
        if (!this.#textures.delete(image)) return;
        texture.dispose();
        bitmap.close();
      },
    };
    this.#textures.set(image, texture);
    return image;
  }
}

function dataTextureOf(bitmap: ImageBitmap): Texture {
  const texture = new Texture(bitmap);
  setDataSampling(texture);
  texture.flipY = false;
  texture.premultiplyAlpha = false;
  texture.needsUpdate = true;
  return texture;
}
