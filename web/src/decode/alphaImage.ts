// Decodes texture images with alpha where the browser's ImageBitmap loses the colours of transparent texels: Safari's
// multiplies them by alpha whatever is asked for. A module of its own, for browsers that are not known to keep them.

import { readBitmap } from "./bitmapPixels.ts";
import { DecodeError } from "./decodeError.ts";
import { opaqueWebp } from "./opaqueWebp.ts";
import type { Texels } from "./pngTexels.ts";
import { isWebp } from "./webpContainer.ts";
import type { TexelArray, TextureDecoding, TextureFile } from "./textureImage.ts";

const firstByteOfPng = 0x89;

let test: Promise<boolean> | undefined;

/**
 * Most PNG files and lossless WebP are decoded by our own decoders in a worker. Of lossy WebP, the browser decodes
 * colours and alpha one after the other. It decodes all other formats once more, for an element, whose colours WebGL
 * gets as the file has them. Pixels that the browser decodes are read on the main thread, all at once. The upload of
 * the texels is then divided into strips, like that of other textures. Rejects with the signal's reason.
 */
export async function decodeAlphaImage(file: TextureFile, decoding: TextureDecoding): Promise<TexelArray | undefined> {
  test ??= losesColors();
  if (isGif(file.bytes) || !(await test)) return undefined;
  const texels =
    (await texelsOfWorker(file, decoding)) ??
    (await texelsOfWebp(file, decoding)) ??
    (await texelsOfElement(file, decoding));
  return texels && { ...texels, close: () => undefined };
}

/** Transparent texels of GIF have no colour. */
function isGif(bytes: Uint8Array): boolean {
  return String.fromCharCode(...bytes.subarray(0, 3)) === "GIF";
}

/** A PNG of one red texel with an alpha of 0. */
const transparentRed =
  "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mP4z8DAAAAEAQEAmFjYzgAA" + "AABJRU5ErkJggg==";

/** Whether an ImageBitmap that was asked to keep colours has lost one. Those of ImageData keep it in WebKit. */
async function losesColors(): Promise<boolean> {
  const png = Uint8Array.from(atob(transparentRed), (character) => character.charCodeAt(0));
  const bitmap = await createImageBitmap(new Blob([png]), { premultiplyAlpha: "none" });
  try {
    return readBitmap(bitmap)[0] !== 255;
  } catch {
    return true; // what can be decoded without WebGL is right then
  } finally {
    bitmap.close();
  }
}

/** Undefined where our decoders leave a file to the browser, or there are none. */
async function texelsOfWorker(
  { bytes }: TextureFile,
  { isData, maxEdge, runJob, signal }: TextureDecoding,
): Promise<Texels | undefined> {
  if (bytes[0] !== firstByteOfPng && !isWebp(bytes)) return undefined;
  try {
    return await runJob("imageTexels", { bytes, isData, maxEdge }, signal);
  } catch (error) {
    if (error instanceof DecodeError) return undefined; // the module of workers cannot be loaded
    throw error;
  }
}

/**
 * Colours of the image without its alpha, and alpha of the whole one: for elements, too, WebKit decodes texels of WebP
 * with an alpha of 0 to black. Undefined for other formats, and where the browser does not decode it.
 */
async function texelsOfWebp({ bytes }: TextureFile, { isData, maxEdge }: TextureDecoding): Promise<Texels | undefined> {
  const opaque = opaqueWebp(bytes);
  if (opaque === undefined) return undefined;
  const bitmaps: ImageBitmap[] = [];
  try {
    for (const part of [opaque, bytes])
      bitmaps.push(
        await createImageBitmap(new Blob([part]), {
          premultiplyAlpha: "none",
          imageOrientation: "flipY",
          colorSpaceConversion: isData ? "none" : "default",
        }),
      );
    const [{ width, height }] = bitmaps as [ImageBitmap];
    if (Math.max(width, height) > maxEdge) return undefined;
    const [data, alphas] = bitmaps.map((bitmap) => readBitmap(bitmap)) as [Texels["data"], Texels["data"]];
    for (let at = 3; at < data.length; at += 4) data[at] = alphas[at] ?? 0;
    return { width, height, data };
  } catch {
    return undefined;
  } finally {
    for (const bitmap of bitmaps) bitmap.close();
  }
}

/** Undefined where the page's policy forbids images of this server, and where the image is too large to be read. */
async function texelsOfElement(
  { url }: TextureFile,
  { isData, maxEdge }: TextureDecoding,
): Promise<Texels | undefined> {
  // Policies of most pages forbid images from data: URLs, and a browser reports each that it refuses.
  if (!/^(https?|blob):/.test(url)) return undefined;
  const image = await loaded(url);
  if (image === undefined || Math.max(image.width, image.height) > maxEdge) return undefined;
  try {
    const data = readBitmap(image, { isBottomUp: true, convertsColors: !isData });
    return { width: image.width, height: image.height, data };
  } catch (error) {
    if (error instanceof DecodeError) return undefined;
    throw error;
  }
}

/** The image of a file that has been requested before, so that it usually comes from the browser's cache. */
function loaded(url: string): Promise<HTMLImageElement | undefined> {
  return new Promise((resolve) => {
    const image = new Image();
    image.crossOrigin = "anonymous"; // as files are fetched
    image.onload = () => {
      resolve(image);
    };
    image.onerror = () => {
      resolve(undefined);
    };
    image.src = url;
  });
}
