// Uploads images as textures, strip by strip, so that no single step delays a frame. Texels keep the
// bytes of the file. JavaScript keeps no copy, except of images that wait for the textures of those
// that they replace.

import { Box2, DataTexture, RGBAFormat, Texture, UnsignedByteType, Vector2, type WebGLRenderer } from "three";
import type { DecodedImage, WritableImage } from "../../stage/decodedImage.ts";
import type { TexelArray } from "../../decode/textureImage.ts";
import type { SamplingDescription } from "../../document/description.ts";
import { maxWaitingBytes, SpareMemory } from "./spareMemory.ts";
import { setDataSampling, setSampling } from "./textureSampling.ts";

/** An image that is being uploaded. */
export interface TextureUpload {
  /**
   * Stands for the texture, which is complete after the last step. Closing it frees the texture, even before the last
   * step.
   */
  readonly image: DecodedImage;
  /** Each step yields the number of bytes that it has uploaded. */
  readonly steps: Generator<number, void, void>;
}

/** An image that is uploaded when a draw needs its texture. */
interface WaitingImage {
  readonly bitmap: ImageBitmap | TexelArray;
  readonly renderer: WebGLRenderer;
}

/** An image whose texels can be replaced, and no draw has needed yet. `texels`: the newest. */
interface WritableTexels {
  texels: Uint8Array<ArrayBuffer> | undefined;
}

/** Images of three channels have four on the GPU, too. */
const bytesPerTexel = 4;
const bytesPerStep = 2 ** 18;

export class TextureStore {
  /**
   * While geometries are being replaced, images of vertex data wait until a draw needs them: they then take the textures
   * of those before. Only as many as may be uploaded in one frame.
   */
  isReplacing = false;
  readonly #textures = new WeakMap<DecodedImage, Texture | WaitingImage | WritableTexels>();
  #waitingBytes = 0;
  readonly #spare = new SpareMemory<DataTexture>((texture) => {
    texture.dispose();
  });
  #bytes = 0;

  /** Total size of all textures that are not closed. */
  get bytes(): number {
    return this.#bytes;
  }

  /** Images of vertex data are being replaced: their memory is kept for a while for others of the same size. */
  expectReplacements(): void {
    this.#spare.expectReplacements();
  }

  /** Frees memory that is kept for others. */
  freeSpares(): void {
    this.#spare.clear();
  }

  /** The texture of an image. Throws RangeError if the image is not from this store, or is closed. */
  textureOf(image: DecodedImage): Texture {
    const held = this.#textures.get(image);
    if (held === undefined) throw new RangeError("the image is not on the GPU");
    if (held instanceof Texture) return held;
    const texture = this.#take(image.width, image.height);
    this.#textures.set(image, texture);
    if (isWritable(held)) {
      if (held.texels !== undefined) writeTexels(texture, held.texels);
      return texture;
    }
    const { bitmap, renderer } = held;
    this.#waitingBytes -= bytesOf(image);
    for (const steps = uploadStrips(bitmap, texture, renderer); steps.next().done !== true;);
    return texture;
  }

  /**
   * Makes an image of vertex data whose texels can be replaced, all at once, before a frame is drawn. Its texture is
   * allocated when a draw needs it: it may then take that of an image that it replaces.
   */
  makeWritable(width: number, height: number): WritableImage {
    const image = this.#add({ texels: undefined }, { width, height }, true);
    return {
      image,
      write: (texels) => {
        const held = this.#textures.get(image);
        if (held instanceof DataTexture) writeTexels(held, texels);
        else if (held !== undefined && isWritable(held)) held.texels = texels;
      },
    };
  }

  /** Begins the upload of a bitmap, which it takes over. Without `sampling`, texels are vertex data. */
  begin(bitmap: ImageBitmap | TexelArray, renderer: WebGLRenderer, sampling?: SamplingDescription): TextureUpload {
    const { width, height } = bitmap;
    if (sampling === undefined && this.isReplacing && this.#waitingBytes + bytesOf(bitmap) <= maxWaitingBytes) {
      this.#waitingBytes += bytesOf(bitmap);
      return { image: this.#add({ bitmap, renderer }, bitmap, true), steps: deferredUpload(bytesOf(bitmap)) };
    }
    const texture = sampling === undefined ? this.#take(width, height) : emptyTexture(width, height);
    if (sampling !== undefined) setSampling(texture, sampling);
    const image = this.#add(texture, bitmap, sampling === undefined, bitmap);
    return { image, steps: uploadStrips(bitmap, texture, renderer) };
  }

  #take(width: number, height: number): DataTexture {
    return this.#spare.take(sizeKeyOf(width, height)) ?? emptyTexture(width, height);
  }

  /**
   * `isReusable`: after it is closed, the texture may become that of another image of this size. `bitmap`: is being
   * uploaded.
   */
  #add(
    held: Texture | WaitingImage | WritableTexels,
    { width, height }: Size,
    isReusable = false,
    bitmap?: ImageBitmap | TexelArray,
  ): DecodedImage {
    const hasMipmaps = held instanceof Texture && held.generateMipmaps;
    const bytes = bytesOf({ width, height }) * (hasMipmaps ? 4 / 3 : 1);
    this.#bytes += bytes;
    const image = {
      width,
      height,
      close: () => {
        const held = this.#textures.get(image);
        if (held === undefined) return;
        this.#textures.delete(image);
        this.#bytes -= bytes;
        bitmap?.close();
        if (!(held instanceof Texture)) {
          if (isWritable(held)) return;
          this.#waitingBytes -= bytes;
          held.bitmap.close();
        } else if (isReusable && held instanceof DataTexture) {
          forgetTexels(held);
          this.#spare.release(sizeKeyOf(width, height), held);
        } else {
          held.dispose();
        }
      },
    };
    this.#textures.set(image, held);
    return image;
  }
}

interface Size {
  readonly width: number;
  readonly height: number;
}

function bytesOf({ width, height }: Size): number {
  return width * height * bytesPerTexel;
}

function sizeKeyOf(width: number, height: number): string {
  return `${width} ${height}`;
}

/** Uploads a bitmap strip by strip, and closes it; the last strip generates the mipmaps. */
function* uploadStrips(
  bitmap: ImageBitmap | TexelArray,
  target: Texture,
  renderer: WebGLRenderer,
): Generator<number, void, void> {
  const { width, height } = bitmap;
  const source = textureFrom(bitmap);
  const { generateMipmaps } = target;
  renderer.initTexture(target);
  const rows = Math.max(1, Math.floor(bytesPerStep / (width * bytesPerTexel)));
  for (let first = 0; first < height; first += rows) {
    const strip = new Box2(new Vector2(0, first), new Vector2(width, Math.min(first + rows, height)));
    target.generateMipmaps = generateMipmaps && first + rows >= height;
    renderer.copyTextureToTexture(source, target, strip, strip.min);
    yield width * (strip.max.y - strip.min.y) * bytesPerTexel;
  }
  bitmap.close();
}

/** A texture whose image is not on the GPU. */
export function textureFrom(bitmap: ImageBitmap | TexelArray): Texture {
  return "data" in bitmap ? new DataTexture(bitmap.data, bitmap.width, bitmap.height) : new Texture(bitmap);
}

/** Accounts for an upload that happens later, when a draw needs the image. */
function* deferredUpload(byteLength: number): Generator<number, void, void> {
  yield byteLength;
}

function isWritable(held: Texture | WaitingImage | WritableTexels): held is WritableTexels {
  return "texels" in held;
}

/** Frees the memory of texels that have been written in JavaScript; the texture keeps its own. */
function forgetTexels(texture: DataTexture): void {
  const { width, height } = texture.image as { width: number; height: number };
  texture.image = { data: null, width, height };
  texture.source.dataReady = false;
}

/** Replaces the texels of a data texture: three.js uploads them into the same texture before it draws it. */
export function writeTexels(texture: DataTexture, texels: Uint8Array<ArrayBuffer>): void {
  const { width, height } = texture.image as { width: number; height: number };
  texture.image = { data: texels, width, height };
  texture.source.dataReady = true;
  texture.needsUpdate = true;
}

export function emptyTexture(width: number, height: number): DataTexture {
  const texture = new DataTexture(null, width, height, RGBAFormat, UnsignedByteType);
  texture.source.dataReady = false;
  setDataSampling(texture);
  texture.needsUpdate = true;
  return texture;
}
