// A decoded image of a lossless video, and the frame of vertices that its pixels are (docs/formats/video.md).
// src/video/video_image.h does the same; vectors/video-1 binds both.

import { crc32 } from "../crc32.ts";
import { DecodeError } from "../decodeError.ts";
import type { FrameArrays } from "../frame/frameArrays.ts";
import { arraysOfFrame } from "../frame/frameArrays.ts";
import type { Frame } from "../frame/frame.ts";
import type { FrameImages } from "../frame/frameImages.ts";
import { imagesOfFrame } from "../frame/frameImages.ts";
import type { FrameHeader, FrameLayout } from "../frame/frameHeader.ts";
import { componentRunsOf, unpackedBytesOf } from "../frame/frameHeader.ts";
import type { FrameForm } from "../sequence/sequenceFrames.ts";
import { maxVideoEdge } from "./webm.ts";

/** Columns of vertices that are no grid, and the fewest of any image: the last row holds eight bytes. */
const widthWithoutGrid = 1024;
const minWidth = 8;

export interface VideoSize {
  readonly width: number;
  readonly height: number;
}

/** The size of the images of a video. Throws DecodeError for frames that are too large. */
export function videoSizeOf(layout: FrameLayout): VideoSize {
  const columns = layout.columns > 0 ? layout.columns : Math.min(layout.vertices, widthWithoutGrid);
  const width = Math.max(columns, minWidth);
  const rows = Math.ceil(layout.vertices / width);
  const height = rows * Math.ceil(unpackedBytesOf(layout) / layout.vertices / 3) + 1;
  if (width > maxVideoEdge || height > maxVideoEdge)
    throw new DecodeError(
      "limit",
      `has frames that need images of ${width} x ${height} pixels; those of a video have up to ${maxVideoEdge} x ${maxVideoEdge}`,
    );
  return { width, height };
}

/** The bytes of a decoded image. */
export interface VideoPixels {
  readonly bytes: Uint8Array<ArrayBuffer>;
  /** Where the first value of red, green and blue is. */
  readonly offsets: readonly [red: number, green: number, blue: number];
  /** Bytes from one row to the next, of each. */
  readonly strides: readonly [red: number, green: number, blue: number];
  /** Bytes from one pixel to the next: 1 in planes, 4 where colours lie side by side. */
  readonly step: number;
}

export interface VideoFrameJob {
  readonly pixels: VideoPixels;
  readonly layout: FrameLayout;
  readonly rate: number;
  /** That the frame must have. */
  readonly number: number;
  readonly form: FrameForm;
}

/** Throws DecodeError. */
export function videoFrame({ form, ...image }: VideoFrameJob): FrameImages | FrameArrays {
  const frame = frameOfVideo(image);
  return form.kind === "images" ? imagesOfFrame(frame) : arraysOfFrame(frame, form.normalSource);
}

/** Throws DecodeError for pixels that are not those of the frame: they were not encoded or decoded without loss. */
export function frameOfVideo({ pixels, layout, rate, number }: Omit<VideoFrameJob, "form">): Frame {
  const size = videoSizeOf(layout);
  const rgb = rgbOf(pixels, size);
  const view = new DataView(rgb.buffer);
  const lastRow = 3 * size.width * (size.height - 1);
  if (view.getUint32(lastRow + 4) !== crc32(rgb.subarray(0, lastRow + 4)))
    throw new DecodeError(
      "malformed",
      `has pixels in frame ${number} that are not those that were recorded: it is not lossless`,
    );
  const found = view.getUint32(lastRow);
  if (found !== number) throw new DecodeError("malformed", `has frame ${found} instead of frame ${number}`);
  return { header: headerOf(layout, number, rate), components: componentsOf(rgb, size, layout) };
}

/** Red, green and blue of each pixel, one behind the other. */
function rgbOf({ bytes, offsets, strides, step }: VideoPixels, { width, height }: VideoSize): Uint8Array<ArrayBuffer> {
  const rgb = new Uint8Array(3 * width * height);
  for (const [channel, first] of offsets.entries()) {
    let out = channel;
    for (let y = 0, row = first; y < height; ++y, row += strides[channel] ?? 0)
      for (let x = 0, at = row; x < width; ++x, at += step, out += 3) rgb[out] = bytes[at] ?? 0;
  }
  return rgb;
}

function componentsOf(rgb: Uint8Array, { width }: VideoSize, layout: FrameLayout): Frame["components"] {
  const { vertices } = layout;
  const imageBytes = 3 * width * Math.ceil(vertices / width);
  const components: Uint32Array<ArrayBuffer>[] = [];
  let plane = 0;
  for (const { count, bits } of componentRunsOf(layout)) {
    const run = Array.from({ length: count }, () => new Uint32Array(vertices));
    for (let byte = Math.ceil(bits / 8); byte > 0; --byte)
      for (const values of run) {
        let at = Math.floor(plane / 3) * imageBytes + (plane % 3);
        for (let vertex = 0; vertex < vertices; ++vertex, at += 3)
          values[vertex] = ((values[vertex] ?? 0) << 8) | (rgb[at] ?? 0);
        plane += 1;
      }
    components.push(...run);
  }
  return components;
}

function headerOf(layout: FrameLayout, number: number, rate: number): FrameHeader {
  return {
    vertices: layout.vertices,
    columns: layout.columns,
    positionBits: layout.positionBits,
    normalBits: layout.normalBits,
    colorComponents: layout.colorComponents,
    valueComponents: layout.valueComponents,
    valueBits: layout.valueBits,
    number,
    epoch: 0,
    time: number / rate,
    prediction: "none",
    isDifference: false,
    packedBytes: 0,
  };
}
