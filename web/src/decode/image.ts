// Checks an image of vertex data and decodes it with the browser.

import type { DecodedImage } from "../stage/decodedImage.ts";
import { DecodeError } from "./decodeError.ts";
import type { PngHeader } from "./png.ts";
import { checkPng } from "./png.ts";

/** An image, and the number of channels in its file: browsers decode every image to four. */
export interface DataImage<Image extends DecodedImage = DecodedImage> {
  readonly image: Image;
  readonly channels: PngHeader["channels"];
}

/** Decodes a PNG to exactly its stored bytes. Rejects if that is not possible. */
export type ImageDecoder<Image extends DecodedImage> = (png: Uint8Array<ArrayBuffer>) => Promise<Image>;

/**
 * Checks and decodes a PNG. The image has the size that the header states. Rejects with DecodeError; an image that was
 * decoded is then closed.
 */
export async function decodeImage<Image extends DecodedImage>(
  png: Uint8Array<ArrayBuffer>,
  decoder: ImageDecoder<Image>,
  maxEdge?: number,
): Promise<DataImage<Image>> {
  const header = checkPng(png, maxEdge);
  let image: Image;
  try {
    image = await decoder(png);
  } catch {
    throw new DecodeError("malformed", "is a PNG that does not decode");
  }
  if (image.width === header.width && image.height === header.height) return { image, channels: header.channels };
  image.close();
  throw new DecodeError(
    "malformed",
    `decoded to ${image.width} x ${image.height} texels, not ${header.width} x ${header.height}`,
  );
}

/** Decodes with the browser, without premultiplication by alpha and colour conversion. */
export async function decodeWithBrowser(png: Uint8Array<ArrayBuffer>): Promise<ImageBitmap> {
  return createImageBitmap(new Blob([png], { type: "image/png" }), {
    premultiplyAlpha: "none",
    colorSpaceConversion: "none",
  });
}
