import type { Texture } from "three";
import type { DecodedImage } from "../../stage/decodedImage.ts";

/** Where images are that have become textures. */
export interface TextureProvider {
  /** Throws where the image is not one of these, or is closed. */
  textureOf(image: DecodedImage): Texture;
}
