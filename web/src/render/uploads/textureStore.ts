// Images as textures on the GPU. Texels are uploaded in strips, so that no single step delays a
// frame, with the bytes of the file. JavaScript keeps no copy.

import { Box2, DataTexture, RGBAFormat, Texture, UnsignedByteType, Vector2, type WebGLRenderer } from "three";
import type { DecodedImage } from "../../stage/decodedImage.ts";
import type { SamplingDescription } from "../../document/description.ts";
import { setDataSampling, setSampling } from "./textureSampling.ts";

/** An image that is being uploaded. */
export interface TextureUpload {
  /** Stands for the texture, which is complete after the last step. Closing it frees the texture, also before that. */
  readonly image: DecodedImage;
  /** Each step yields the number of bytes that it has uploaded. */
  readonly steps: Generator<number, void, void>;
}

/** WebGL2 stores three channels as four. */
const bytesPerTexel = 4;
const bytesPerStep = 2 ** 18;

export class TextureStore {
  readonly #textures = new WeakMap<DecodedImage, Texture>();
  #bytes = 0;

  /** Total size of all open textures. */
  get bytes(): number {
    return this.#bytes;
  }

  /** Throws RangeError where the image is not from this store, or is closed. */
  textureOf(image: DecodedImage): Texture {
    const texture = this.#textures.get(image);
    if (texture === undefined) throw new RangeError("the image is not on the GPU");
    return texture;
  }

  /** The bitmap may be closed after the last step. Without `sampling` the texels are vertex data. */
  begin(bitmap: ImageBitmap, renderer: WebGLRenderer, sampling?: SamplingDescription): TextureUpload {
    const { width, height } = bitmap;
    const texture = emptyTexture(width, height);
    if (sampling !== undefined) setSampling(texture, sampling);
    const bytes = width * height * bytesPerTexel * (texture.generateMipmaps ? 4 / 3 : 1);
    this.#bytes += bytes;
    const image = {
      width,
      height,
      close: () => {
        if (!this.#textures.delete(image)) return;
        this.#bytes -= bytes;
        texture.dispose();
      },
    };
    this.#textures.set(image, texture);
    return { image, steps: strips(new Texture(bitmap), texture, width, height, renderer) };
  }
}

/** The last strip generates the mipmaps. */
function* strips(
  from: Texture,
  to: Texture,
  width: number,
  height: number,
  renderer: WebGLRenderer,
): Generator<number, void, void> {
  const { generateMipmaps } = to;
  renderer.initTexture(to);
  const rows = Math.max(1, Math.floor(bytesPerStep / (width * bytesPerTexel)));
  for (let first = 0; first < height; first += rows) {
    const strip = new Box2(new Vector2(0, first), new Vector2(width, Math.min(first + rows, height)));
    to.generateMipmaps = generateMipmaps && first + rows >= height;
    renderer.copyTextureToTexture(from, to, strip, strip.min);
    yield width * (strip.max.y - strip.min.y) * bytesPerTexel;
  }
}

function emptyTexture(width: number, height: number): Texture {
  const texture = new DataTexture(null, width, height, RGBAFormat, UnsignedByteType);
  texture.source.dataReady = false;
  setDataSampling(texture);
  texture.needsUpdate = true;
  return texture;
}
