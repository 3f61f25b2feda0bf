// The interface to images that have become textures.

import type { Texture } from "three";
import type { DecodedImage } from "../../stage/decodedImage.ts";

/** Finds the texture of an image. */
export interface TextureProvider {
  /** Throws RangeError where the image is unknown or closed. */
  textureOf(image: DecodedImage): Texture;
}
