// Images of vertex data, in PNG or lossless WebP: what their files state.

import type { ImageHeader } from "./png.ts";
import { checkPng } from "./png.ts";
import { checkWebp } from "./webp.ts";
import { isWebp } from "./webpContainer.ts";

export type { ImageHeader } from "./png.ts";

/** The media type of an image that `checkImage` has accepted. */
export function mediaTypeOf(bytes: Uint8Array): "image/png" | "image/webp" {
  return isWebp(bytes) ? "image/webp" : "image/png";
}

/** Checks an image of vertex data by its format, and returns its size. Safe for untrusted bytes. Throws DecodeError. */
export function checkImage(bytes: Uint8Array, maxEdge?: number): ImageHeader {
  return isWebp(bytes) ? checkWebp(bytes, maxEdge) : checkPng(bytes, maxEdge);
}
