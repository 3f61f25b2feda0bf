// Uploads images as textures, strip by strip, so that no single step delays a frame. Texels keep the
// bytes of the file. JavaScript keeps no copy.

import { Box2, DataTexture, RGBAFormat, Texture, UnsignedByteType, Vector2, type WebGLRenderer } from "three";
import type { DecodedImage, WritableImage } from "../../stage/decodedImage.ts";
import type { SamplingDescription } from "../../document/description.ts";
import { SpareMemory } from "./spareMemory.ts";
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

/** Images of three channels have four on the GPU, too. */
const bytesPerTexel = 4;
const bytesPerStep = 2 ** 18;

export class TextureStore {
  readonly #textures = new WeakMap<DecodedImage, Texture>();
  readonly #spare = new SpareMemory<Texture>((texture) => {
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
    const texture = this.#textures.get(image);
    if (texture === undefined) throw new RangeError("the image is not on the GPU");
    return texture;
  }

  /** Allocates an image of vertex data whose texels can be replaced, all at once, before a frame is drawn. */
  makeWritable(width: number, height: number): WritableImage {
    const texture = emptyTexture(width, height);
    return {
      image: this.#add(texture, width, height),
      write: (texels) => {
        writeTexels(texture, texels);
      },
    };
  }

  /**
   * Begins the upload of a bitmap, which may be closed after the last step. Without `sampling`, texels are vertex data.
   */
  begin(bitmap: ImageBitmap, renderer: WebGLRenderer, sampling?: SamplingDescription): TextureUpload {
    const { width, height } = bitmap;
    const spare = sampling === undefined ? this.#spare.take(sizeKeyOf(width, height)) : undefined;
    const texture = spare ?? emptyTexture(width, height);
    if (sampling !== undefined) setSampling(texture, sampling);
    const image = this.#add(texture, width, height, sampling === undefined);
    return { image, steps: uploadStrips(new Texture(bitmap), texture, width, height, renderer) };
  }

  /** `isReusable`: after it is closed, the texture may become that of another image of this size. */
  #add(texture: Texture, width: number, height: number, isReusable = false): DecodedImage {
    const bytes = width * height * bytesPerTexel * (texture.generateMipmaps ? 4 / 3 : 1);
    this.#bytes += bytes;
    const image = {
      width,
      height,
      close: () => {
        if (!this.#textures.delete(image)) return;
        this.#bytes -= bytes;
        if (isReusable) this.#spare.release(sizeKeyOf(width, height), texture);
        else texture.dispose();
      },
    };
    this.#textures.set(image, texture);
    return image;
  }
}

function sizeKeyOf(width: number, height: number): string {
  return `${width} ${height}`;
}

/** Uploads `source` into `target` strip by strip; the last strip generates the mipmaps. */
function* uploadStrips(
  source: Texture,
  target: Texture,
  width: number,
  height: number,
  renderer: WebGLRenderer,
): Generator<number, void, void> {
  const { generateMipmaps } = target;
  renderer.initTexture(target);
  const rows = Math.max(1, Math.floor(bytesPerStep / (width * bytesPerTexel)));
  for (let first = 0; first < height; first += rows) {
    const strip = new Box2(new Vector2(0, first), new Vector2(width, Math.min(first + rows, height)));
    target.generateMipmaps = generateMipmaps && first + rows >= height;
    renderer.copyTextureToTexture(source, target, strip, strip.min);
    yield width * (strip.max.y - strip.min.y) * bytesPerTexel;
  }
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
