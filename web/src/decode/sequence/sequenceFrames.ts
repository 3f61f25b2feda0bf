// Files of a sequence: frames that follow one another (docs/formats/sequence.md), and the job that decodes a run of
// them. src/sequence/sequence_file.h does the same.

import { DecodeError } from "../decodeError.ts";
import type { FrameArrays, NormalSource } from "../frame/frameArrays.ts";
import { arraysOfFrame } from "../frame/frameArrays.ts";
import type { Frame } from "../frame/frame.ts";
import { decodeFrameAfter } from "../frame/frame.ts";
import type { FrameImages } from "../frame/frameImages.ts";
import { imagesOfFrame } from "../frame/frameImages.ts";
import type { FrameLayout } from "../frame/frameHeader.ts";
import { frameHeaderBytes, readFrameHeader } from "../frame/frameHeader.ts";
import type { SequenceFile } from "./sequenceIndex.ts";

export interface PackedFrame {
  readonly number: number;
  readonly bytes: Uint8Array<ArrayBuffer>;
  /** Whether the frame before it must be decoded first. */
  readonly isDifference: boolean;
}

const layoutFields = [
  "vertices",
  "columns",
  "positionBits",
  "normalBits",
  "colorComponents",
  "valueComponents",
  "valueBits",
] as const;

/**
 * The frames of a file, each in memory of its own, with their headers checked against the index. Safe for untrusted
 * bytes. Throws DecodeError.
 */
export function framesOfFile(
  bytes: Uint8Array<ArrayBuffer>,
  { first, frames }: SequenceFile,
  layout: FrameLayout,
): readonly PackedFrame[] {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const packed: PackedFrame[] = [];
  let at = 0;
  for (let number = first; number < first + frames; ++number) {
    if (bytes.length - at < frameHeaderBytes) throw new DecodeError("truncated", `ends before frame ${number}`);
    const end = at + frameHeaderBytes + view.getUint32(at + 4, true);
    const frame = bytes.slice(at, end);
    const header = readFrameHeader(frame, true);
    if (header.number !== number || header.epoch !== 0)
      throw new DecodeError("malformed", `has frame ${header.number} instead of frame ${number}`);
    if (layoutFields.some((field) => header[field] !== layout[field]))
      throw new DecodeError("malformed", `has other vertices or attributes in frame ${number} than its index states`);
    if (number === first && header.isDifference)
      throw new DecodeError("malformed", "begins with a difference to a frame that is not there");
    packed.push({ number, bytes: frame, isDifference: header.isDifference });
    at = end;
  }
  if (at !== bytes.length) throw new DecodeError("malformed", "goes on after its last frame");
  return packed;
}

export interface SequenceFramesJob {
  /** Frames that follow one another. */
  readonly frames: readonly Uint8Array<ArrayBuffer>[];
  /** The components of the frame before the first; undefined: the first stands alone. */
  readonly before: Frame["components"] | undefined;
  /** The position of the first frame to return; those before it are decoded for it. */
  readonly from: number;
  readonly form: FrameForm;
}

/** What frames are decoded to: images, or arrays with normals where frames have none. */
export type FrameForm =
  { readonly kind: "images" } | { readonly kind: "arrays"; readonly normalSource: NormalSource | undefined };

export interface SequenceFrames {
  readonly frames: readonly (FrameImages | FrameArrays)[];
  /** The components of the last frame, for the job that goes on behind it. */
  readonly last: Frame["components"];
}

/** Rejects with DecodeError. */
export async function sequenceFrames({ frames, before, from, form }: SequenceFramesJob): Promise<SequenceFrames> {
  const decoded: (FrameImages | FrameArrays)[] = [];
  let last = before;
  for (const [position, bytes] of frames.entries()) {
    const frame = await decodeFrameAfter(bytes, last);
    last = frame.components;
    if (position >= from)
      decoded.push(form.kind === "images" ? imagesOfFrame(frame) : arraysOfFrame(frame, form.normalSource));
  }
  return { frames: decoded, last: last ?? [] };
}
