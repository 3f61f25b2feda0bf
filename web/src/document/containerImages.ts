// The images of an ImageGeometry that are child nodes, X3DOM's form: ImageTexture and Texture with a url or an <img> or
// <canvas> in them, or these two alone. `containerField` states what an image holds.

import type { Resolve, SceneElement } from "./element.ts";
import { attributeOf, childrenOf, lowerNameOf, substitutedFor } from "./element.ts";
import { MFString, SFString } from "./fieldTypes.ts";
import type { Values, Warning } from "./nodes.ts";
import { nodeFields, readFields } from "./nodes.ts";
import { entryOf } from "./tables.ts";
import { texCoordRoles } from "../stage/attributeRows.ts";

type PatchValues = Values<typeof nodeFields.GeometryPatch>;

/** Fields of ImageGeometry that images fill, in their exact case, as X3DOM has them. */
const imageFields = ["index", "coord", "normal", "texCoord", "color"] as const;
type ImageField = (typeof imageFields)[number];

/**
 * References that replace those of the node's own fields, in document order, which is the order of several images of
 * one field.
 */
export function containerImagesOf(element: SceneElement, resolve: Resolve, warnings: Warning[]): Partial<PatchValues> {
  const urls: Record<ImageField, string[]> = { index: [], coord: [], normal: [], texCoord: [], color: [] };
  for (const child of childrenOf(element)) {
    if (!entryOf(urlReaders, lowerNameOf(child))) continue;
    const used = resolve(child);
    if (used === undefined) {
      warnings.push({ element: child, message: `USE="${attributeOf(child, "USE") ?? ""}" names no DEF of this scene` });
      continue;
    }
    const image = substitutedFor(child, used);
    const name = attributeOf(image, "containerField") ?? attributeOf(used, "containerField") ?? "";
    const field = imageFields.find((known) => known === name);
    if (field === undefined) {
      warnings.push({ element: child, message: `containerField="${name}" names no part of a geometry` });
      continue;
    }
    const url = entryOf(urlReaders, lowerNameOf(used))?.(used, warnings);
    if (url !== undefined) urls[field].push(url);
  }
  const { index, coord, normal, texCoord, color } = urls;
  const warnOfFurther = (field: ImageField, used: number) => {
    if (urls[field].length > used)
      warnings.push({ element, message: `only the first ${used} of ${urls[field].length} ${field} images are used` });
  };
  warnOfFurther("index", 1);
  warnOfFurther("normal", 2);
  warnOfFurther("color", 3);
  warnOfFurther("texCoord", texCoordRoles.length);
  const sets = texCoordRoles.flatMap((role, set) => (texCoord[set] === undefined ? [] : [[role, [texCoord[set]]]]));
  return {
    ...(coord.length > 0 && { coord }),
    ...(index[0] !== undefined && { index: index[0] }),
    ...(normal.length > 0 && { normal: normal.slice(0, 2) }),
    ...(color.length > 0 && { color: color.slice(0, 3) }),
    ...(Object.fromEntries(sets) as Partial<PatchValues>),
  };
}

/** Whether a URL, which may have a query with a token, names a live stream (docs/live.md). */
export function isStreamUrl(url: string): boolean {
  return /(^|\/)live\/[\w-]{1,64}(\?|$)/.test(url);
}

type UrlReader = (element: SceneElement, warnings: Warning[]) => string | undefined;

const refusedMovie = refused("movies are not drawn; images and live streams are");

/** Readers of the address of an image, by the element's lower-case name; each warns where it finds none. */
const urlReaders: Readonly<Record<string, UrlReader>> = {
  imagetexture: textureUrl,
  texture: textureUrl,
  pixeltexture: refused("the pixels of a PixelTexture are not read as geometry; images are"),
  img(element, warnings) {
    const { src } = readFields(element, { src: SFString("") }, warnings);
    if (src !== "") return src;
    warnings.push({ element, message: "an image without src has no part in the scene" });
    return undefined;
  },
  canvas: canvasUrl,
  movietexture(element, warnings) {
    const [first] = readFields(element, { url: MFString([]) }, warnings).url;
    return first !== undefined && isStreamUrl(first) ? first : refusedMovie(element, warnings);
  },
  video: refusedMovie,
};

/** The first of the texture's addresses, or its first child that is an image. */
function textureUrl(element: SceneElement, warnings: Warning[]): string | undefined {
  const [first] = readFields(element, nodeFields.ImageTexture, warnings).url;
  if (first !== undefined) return first;
  if (innerImage(element)) return imageUrlIn(element, warnings);
  warnings.push({ element, message: "a texture without url and without an image in it has no part in a geometry" });
  return undefined;
}

/** The element of HTML in a texture that holds its image. */
function innerImage(element: SceneElement): SceneElement | undefined {
  return childrenOf(element).find((child) => ["img", "canvas", "video"].includes(lowerNameOf(child)));
}

/** The address of the image of a texture without url: an `<img>` or `<canvas>` in it, X3DOM's form. */
export function imageUrlIn(element: SceneElement, warnings: Warning[]): string | undefined {
  const child = innerImage(element);
  return child && urlReaders[lowerNameOf(child)]?.(child, warnings);
}

/** An element of a page that can be drawn on. */
interface Canvas extends SceneElement {
  toDataURL(type: string): string;
}

/** The pixels that a canvas has when the document is read. */
function canvasUrl(element: SceneElement, warnings: Warning[]): string | undefined {
  if (!("toDataURL" in element)) {
    warnings.push({ element, message: "a canvas has pixels only in a page" });
    return undefined;
  }
  try {
    return (element as Canvas).toDataURL("image/png");
  } catch {
    // SecurityError: a canvas on which an image of another origin was drawn may not be read.
    warnings.push({
      element,
      message: "the browser does not allow to read this canvas: it shows another site's image",
    });
    return undefined;
  }
}

function refused(message: string): UrlReader {
  return (element, warnings) => {
    warnings.push({ element, message });
    return undefined;
  };
}
