// Checks an image of vertex data and decodes it with the browser.

import type { DecodedImage } from "../stage/decodedImage.ts";
import { DecodeError } from "./decodeError.ts";
import type { ImageHeader } from "./imageFile.ts";
import { checkImage, mediaTypeOf } from "./imageFile.ts";

/** An image, and the number of channels in its file: browsers decode every image to four. */
export interface DataImage<Image extends DecodedImage = DecodedImage> {
  readonly image: Image;
  readonly channels: ImageHeader["channels"];
}

/** Decodes an image file to exactly its stored bytes. Rejects if that is not possible. */
export type ImageDecoder<Image extends DecodedImage> = (bytes: Uint8Array<ArrayBuffer>) => Promise<Image>;

/**
 * Checks and decodes a PNG or a lossless WebP. The image has the size that the header states. Rejects with DecodeError;
 * an image that was decoded is then closed.
 */
export async function decodeImage<Image extends DecodedImage>(
  bytes: Uint8Array<ArrayBuffer>,
  decoder: ImageDecoder<Image>,
  maxEdge?: number,
): Promise<DataImage<Image>> {
  const header = checkImage(bytes, maxEdge);
  let image: Image;
  try {
    image = await decoder(bytes);
  } catch {
    throw new DecodeError("malformed", "is an image that does not decode");
  }
  if (image.width === header.width && image.height === header.height) return { image, channels: header.channels };
  image.close();
  throw new DecodeError(
    "malformed",
    `decoded to ${image.width} x ${image.height} texels, not ${header.width} x ${header.height}`,
  );
}

/** `decodeImage` with the browser. */
export async function decodeDataImage(
  bytes: Uint8Array<ArrayBuffer>,
  maxEdge: number,
): Promise<DataImage<ImageBitmap>> {
  return decodeImage(bytes, decodeWithBrowser, maxEdge);
}

/** Decodes with the browser, without premultiplication by alpha and colour conversion. */
export async function decodeWithBrowser(bytes: Uint8Array<ArrayBuffer>): Promise<ImageBitmap> {
  return createImageBitmap(new Blob([bytes], { type: mediaTypeOf(bytes) }), {
    premultiplyAlpha: "none",
    colorSpaceConversion: "none",
  });
}
