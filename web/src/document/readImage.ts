// Reads texture nodes that hold an image.

import { imageUrlsIn } from "./containerImages.ts";
import { dataUrl } from "./dataUrl.ts";
import type { ImageDescription, SamplingDescription, WrapMode } from "./description.ts";
import type { SceneElement } from "./element.ts";
import { attributeOf, lowerNameOf } from "./element.ts";
import type { Values, Warning } from "./nodes.ts";
import { nodeFields, readFields } from "./nodes.ts";
import { pngOfPixels } from "./pixelImage.ts";

/** An element's children, with USEs resolved. */
export type ChildrenOf = (element: SceneElement) => readonly SceneElement[];

export function isTexture(child: SceneElement): boolean {
  return ["imagetexture", "texture", "pixeltexture"].includes(lowerNameOf(child));
}

/** The texture's containerField in lower case; empty where it has none. */
export function fieldOf(texture: SceneElement): string {
  return attributeOf(texture, "containerField")?.toLowerCase() ?? "";
}

/** Sides of a panorama meet at their edges, so the pictures do not repeat. */
export const edgeToEdge = { wrapS: "clamp", wrapT: "clamp" } as const;

/** The image of an ImageTexture, ImageCubeMapTexture or PixelTexture, as colors; undefined where it has none. */
export function readImageOf(
  element: SceneElement,
  childrenOf: ChildrenOf,
  warnings: Warning[],
): ImageDescription | undefined {
  const { urls, preview, repeatS, repeatT } =
    lowerNameOf(element) === "pixeltexture" ? readPixels(element, warnings) : readImage(element, warnings);
  if (urls.length === 0) return undefined;
  const properties = childrenOf(element).find((child) => lowerNameOf(child) === "textureproperties");
  return { urls, preview, sampling: { ...samplingOf(properties, repeatS, repeatT, warnings), isData: false } };
}

/** The common fields of textures; `urls` is empty where there is no image. */
type ReadTexture = Pick<Values<typeof nodeFields.ImageTexture>, "preview" | "repeatS" | "repeatT"> & {
  readonly urls: readonly string[];
};

function readImage(element: SceneElement, warnings: Warning[]): ReadTexture {
  const { url, ...rest } = readFields(element, nodeFields.ImageTexture, warnings);
  const inner = url.length > 0 ? undefined : imageUrlsIn(element, warnings);
  return { ...rest, urls: inner ?? url };
}

function readPixels(element: SceneElement, warnings: Warning[]): ReadTexture {
  const { image, ...rest } = readFields(element, nodeFields.PixelTexture, warnings);
  return { ...rest, preview: "", urls: image.pixels.length > 0 ? [dataUrl("image/png", pngOfPixels(image))] : [] };
}

function samplingOf(
  element: SceneElement | undefined,
  repeatS: boolean,
  repeatT: boolean,
  warnings: Warning[],
): Omit<SamplingDescription, "isData"> {
  const wrap = (repeats: boolean): WrapMode => (repeats ? "repeat" : "clamp");
  if (element === undefined)
    return { wrapS: wrap(repeatS), wrapT: wrap(repeatT), isSmooth: true, hasMipmaps: true, anisotropy: 1 };
  const values = readFields(element, nodeFields.TextureProperties, warnings);
  const isNearest = (filter: string) => /^(NEAREST|FASTEST)/i.test(filter.trim());
  return {
    wrapS: wrapOf(values.boundaryModeS),
    wrapT: wrapOf(values.boundaryModeT),
    isSmooth: !isNearest(values.magnificationFilter),
    // Mipmaps are on unless a filter without them is requested: minified textures would shimmer.
    hasMipmaps: !/^(NEAREST|AVG|AVG_PIXEL|FASTEST|NEAREST_PIXEL)$/i.test(values.minificationFilter.trim()),
    anisotropy: Math.max(1, values.anisotropicDegree),
  };
}

function wrapOf(mode: string): WrapMode {
  const name = mode.trim().toUpperCase();
  return name.startsWith("CLAMP") ? "clamp" : name === "MIRRORED_REPEAT" ? "mirror" : "repeat";
}
