// Images and how textures sample them.

export type WrapMode = "repeat" | "clamp" | "mirror";

/** How a texture is filtered and wrapped. */
export interface SamplingDescription {
  /** The texels are numbers for shading instead of colors. */
  readonly isData: boolean;
  readonly wrapS: WrapMode;
  readonly wrapT: WrapMode;
  /** False: magnification shows square texels (nearest filter). */
  readonly isSmooth: boolean;
  readonly hasMipmaps: boolean;
  readonly anisotropy: number;
  /** Alpha is a signed distance to the nearest edge instead of an opacity. */
  readonly isDistanceField?: true;
}

/** An image and how it is sampled. */
export interface ImageDescription {
  /** Tried in order until one loads; at least one. */
  readonly urls: readonly string[];
  /** The URL of a small version, displayed until the image is loaded; empty: none. */
  readonly preview: string;
  readonly sampling: SamplingDescription;
}
