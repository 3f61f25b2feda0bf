// How shaders sample a texture.

import type { Texture } from "three";
import {
  NoColorSpace,
  NearestFilter,
  RepeatWrapping,
  MirroredRepeatWrapping,
  ClampToEdgeWrapping,
  LinearMipmapLinearFilter,
  LinearFilter,
} from "three";
import type { SamplingDescription } from "../../document/description.ts";

/** For vertex data: shaders fetch single texels, with the bytes of the file. */
export function setDataSampling(texture: Texture): void {
  texture.colorSpace = NoColorSpace;
  texture.minFilter = NearestFilter;
  texture.magFilter = NearestFilter;
  texture.generateMipmaps = false;
}

const wrappings = { repeat: RepeatWrapping, clamp: ClampToEdgeWrapping, mirror: MirroredRepeatWrapping } as const;

/**
 * For textures of an appearance. Their colours are not converted, like those of materials (materials/x3dMaterials.ts).
 */
export function setSampling(
  texture: Texture,
  { wrapS, wrapT, isSmooth, hasMipmaps, anisotropy }: SamplingDescription,
): void {
  texture.wrapS = wrappings[wrapS];
  texture.wrapT = wrappings[wrapT];
  texture.magFilter = isSmooth ? LinearFilter : NearestFilter;
  texture.minFilter = hasMipmaps ? LinearMipmapLinearFilter : isSmooth ? LinearFilter : NearestFilter;
  texture.generateMipmaps = hasMipmaps;
  texture.anisotropy = anisotropy;
}
