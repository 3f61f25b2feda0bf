// The images of an ImageGeometry that are child nodes, X3DOM's form: ImageTexture and Texture with a url or an <img> or
// <canvas> in them, or these two alone. `containerField` states what an image holds.

import type { Resolve, SceneElement } from "./element.ts";
import { attributeOf, childrenOf, lowerNameOf, substitutedFor, unknownUse } from "./element.ts";
import { MFUrl, SFString } from "./fieldTypes.ts";
import type { Warning } from "./nodes.ts";
import { nodeFields, readFields, shortened } from "./nodes.ts";
import { movieOf } from "./sequence.ts";
import { entryOf } from "./tables.ts";
import { UnreadableGeometry } from "./unreadableGeometry.ts";
import type { VertexRole } from "../stage/attributeRows.ts";
import { texCoordRoles } from "../stage/attributeRows.ts";

/** Fields of ImageGeometry that images fill, as X3DOM has them. */
const imageFields = ["index", "coord", "normal", "texCoord", "color"] as const;
type ImageField = (typeof imageFields)[number];

/** The images of a patch by what they hold: the URLs of each file. Absent where no child has one. */
export type ContainerImages = Partial<Record<"index" | "coord" | VertexRole, readonly (readonly string[])[]>>;

/**
 * Images that replace those of the node's own fields, in document order, which is the order of several images of one
 * field. Throws UnreadableGeometry where one of coordinates or indices cannot be read: the surface would be another one.
 */
export function containerImagesOf(element: SceneElement, resolve: Resolve, warnings: Warning[]): ContainerImages {
  const files: Record<ImageField, (readonly string[])[]> = {
    index: [],
    coord: [],
    normal: [],
    texCoord: [],
    color: [],
  };
  for (const child of childrenOf(element)) {
    if (!entryOf(urlReaders, lowerNameOf(child))) continue;
    const used = resolve(child);
    const image = used && substitutedFor(child, used);
    if (image && lowerNameOf(image) === "movietexture" && movieOf(image)) continue; // frames of a sequence
    const name = attributeOf(image ?? child, "containerField") ?? (used && attributeOf(used, "containerField")) ?? "";
    const field = imageFields.find((known) => known.toLowerCase() === name.toLowerCase());
    const urls =
      field === undefined
        ? { problem: `containerField="${shortened(name)}" names no part of a geometry` }
        : used === undefined
          ? { problem: unknownUse(attributeOf(child, "USE")) }
          : urlsOf(used);
    if (!("problem" in urls)) files[field ?? "coord"].push(urls);
    else if (field === "coord" || field === "index") throw new UnreadableGeometry(urls.problem);
    else warnings.push({ element: child, message: urls.problem });
  }
  const warnOfFurther = (field: ImageField, limit: number) => {
    if (files[field].length > limit)
      warnings.push({ element, message: `only the first ${limit} of ${files[field].length} ${field} images are used` });
  };
  warnOfFurther("index", 1);
  warnOfFurther("texCoord", texCoordRoles.length);
  const { texCoord, ...others } = files;
  const present = Object.entries(others).filter(([, images]) => images.length > 0);
  const sets = texCoordRoles.flatMap((role, set) => (texCoord[set] === undefined ? [] : [[role, [texCoord[set]]]]));
  return Object.fromEntries([...present, ...sets]) as ContainerImages;
}

/** Whether a URL, which may have a query with a token, names a live stream (docs/live.md). */
export function isStreamUrl(url: string): boolean {
  return /(^|\/)live\/[\w-]{1,64}(\?|$)/.test(url);
}

/** The addresses of an image, or the sentence why there are none. */
type ImageUrls = readonly string[] | { readonly problem: string };
type UrlReader = (element: SceneElement) => ImageUrls;

const refusedMovie: UrlReader = () => ({
  problem: "a movie with coordinates names a lossless video and the index of its frames",
});
const refusedVideo: UrlReader = () => ({ problem: "movies are not drawn; images and live streams are" });

/** Readers of the addresses of an image, by the element's lower-case name. */
const urlReaders: Readonly<Record<string, UrlReader>> = {
  imagetexture: textureUrls,
  texture: textureUrls,
  pixeltexture: () => ({ problem: "the pixels of a PixelTexture are not read as geometry; images are" }),
  img(element) {
    const { src } = readFields(element, { src: SFString("") }, []);
    return src === "" ? { problem: "an image without src has no part in the scene" } : [src];
  },
  canvas: canvasUrls,
  movietexture(element) {
    const [first] = readFields(element, { url: MFUrl([]) }, []).url;
    return first !== undefined && isStreamUrl(first) ? [first] : refusedMovie(element);
  },
  video: refusedVideo,
};

function urlsOf(element: SceneElement): ImageUrls {
  return entryOf(urlReaders, lowerNameOf(element))?.(element) ?? { problem: noImage };
}

const noImage = "a texture without url and without an image in it has no part in a geometry";

/** The texture's addresses, or those of its first child that is an image. */
function textureUrls(element: SceneElement): ImageUrls {
  const { url } = readFields(element, nodeFields.ImageTexture, []);
  if (url.length > 0) return url;
  const child = innerImage(element);
  return child ? urlsOf(child) : { problem: noImage };
}

/** The element of HTML in a texture that holds its image. */
function innerImage(element: SceneElement): SceneElement | undefined {
  return childrenOf(element).find((child) => ["img", "canvas", "video"].includes(lowerNameOf(child)));
}

/** The addresses of the image of a texture without url: an `<img>` or `<canvas>` in it, X3DOM's form. */
export function imageUrlsIn(element: SceneElement, warnings: Warning[]): readonly string[] | undefined {
  const child = innerImage(element);
  const urls = child && urlsOf(child);
  if (child === undefined || urls === undefined) return undefined;
  if (!("problem" in urls)) return urls;
  warnings.push({ element: child, message: urls.problem });
  return undefined;
}

/** An element of a page that can be drawn on. */
interface Canvas extends SceneElement {
  toDataURL(type: string): string;
}

/** The pixels that a canvas has when the document is read. */
function canvasUrls(element: SceneElement): ImageUrls {
  if (!("toDataURL" in element)) return { problem: "a canvas has pixels only in a page" };
  try {
    return [(element as Canvas).toDataURL("image/png")];
  } catch {
    // SecurityError: a canvas on which an image of another origin was drawn may not be read.
    return { problem: "the browser does not allow to read this canvas: it shows another site's image" };
  }
}
