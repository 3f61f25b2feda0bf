// One texture per image, shared by the patches that use it and freed with the
// last of them. Bytes reach the shader as they are in the file.

import { ClampToEdgeWrapping, NearestFilter, NoColorSpace, RGBAFormat, Texture, UnsignedByteType } from "three";
import type { DecodedImage } from "../decode/image.ts";

export class TexturePool {
  readonly #textures = new Map<DecodedImage, { texture: Texture; users: number }>();

  acquire(image: DecodedImage): Texture {
    const entry = this.#textures.get(image) ?? { texture: textureOf(image), users: 0 };
    entry.users += 1;
    this.#textures.set(image, entry);
    return entry.texture;
  }

  release(image: DecodedImage): void {
    const entry = this.#textures.get(image);
    if (entry === undefined) return;
    entry.users -= 1;
    if (entry.users > 0) return;
    entry.texture.dispose();
    this.#textures.delete(image);
  }
}

function textureOf(image: DecodedImage): Texture {
  const texture = new Texture(image);
  texture.format = RGBAFormat;
  texture.type = UnsignedByteType;
  texture.colorSpace = NoColorSpace;
  texture.minFilter = NearestFilter;
  texture.magFilter = NearestFilter;
  texture.wrapS = ClampToEdgeWrapping;
  texture.wrapT = ClampToEdgeWrapping;
  texture.generateMipmaps = false;
  texture.flipY = false;
  texture.premultiplyAlpha = false;
  texture.needsUpdate = true;
  return texture;
}
