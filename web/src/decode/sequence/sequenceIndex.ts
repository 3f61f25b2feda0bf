// Reads the index of a sequence: recorded frames in files of about a second each (docs/formats/sequence.md).
// src/sequence/sequence_index.h does the same; vectors/sequence-1 binds both.

import { DecodeError } from "../decodeError.ts";
import type { FrameDescription, JsonObject } from "../frame/frameDescription.ts";
import { objectIn, readFrameDescription } from "../frame/frameDescription.ts";

export const maxSequenceFrames = 2 ** 20;
export const maxSequenceFileFrames = 1024;
export const maxSequenceFileBytes = 2 ** 28;
export const maxSequenceIndexBytes = 2 ** 22;

export interface SequenceFile {
  /** The name of a file beside the index. */
  readonly url: string;
  /** The number of its first frame, which stands alone. */
  readonly first: number;
  readonly frames: number;
  readonly bytes: number;
}

export interface SequenceIndex extends FrameDescription {
  readonly files: readonly SequenceFile[];
  readonly frameCount: number;
  /** The further attribute that the frames' values are; undefined: not stated. */
  readonly valueName: string | undefined;
}

/** Checks untrusted bytes. Throws DecodeError. */
export function readSequenceIndex(bytes: Uint8Array<ArrayBuffer>): SequenceIndex {
  if (bytes.length > maxSequenceIndexBytes) throw new DecodeError("limit", "is too long for the index of a sequence");
  const json = objectIn(new TextDecoder().decode(bytes), "index of a sequence");
  if (!Number.isSafeInteger(json.version)) throw new DecodeError("malformed", 'states no "version" of a sequence');
  if (json.version !== 1)
    throw new DecodeError("unsupported", `is a sequence of version ${String(json.version)}; 1 is read`);
  const description = readFrameDescription(json);
  if (!(description.rate > 0 && description.rate <= 1000))
    throw new DecodeError("malformed", 'states no "rate" above 0, up to 1000');
  const { valueName } = json;
  if (valueName !== undefined && typeof valueName !== "string")
    throw new DecodeError("malformed", 'states a "valueName" that is no text');
  const listed = Array.isArray(json.files) ? (json.files as unknown[]) : [];
  if (listed.length === 0) throw new DecodeError("malformed", "has no files");
  let first = 0;
  const files = listed.map((each): SequenceFile => {
    const file = readFile(each, first);
    first += file.frames;
    return file;
  });
  if (first > maxSequenceFrames) throw new DecodeError("limit", `has ${first} frames; ${maxSequenceFrames} are read`);
  return { ...description, files, frameCount: first, valueName };
}

function readFile(json: unknown, first: number): SequenceFile {
  const { url, frames, bytes } = (typeof json === "object" && json !== null ? json : {}) as JsonObject;
  if (typeof url !== "string" || !/^[\w-][\w.-]{0,127}$/.test(url))
    throw new DecodeError("malformed", 'states a "url" that is no name of a file beside it');
  return {
    url,
    first,
    frames: positive(frames, "frames", maxSequenceFileFrames),
    bytes: positive(bytes, "bytes", maxSequenceFileBytes),
  };
}

function positive(value: unknown, name: string, maximum: number): number {
  if (typeof value !== "number" || !Number.isSafeInteger(value) || value < 1)
    throw new DecodeError("malformed", `has a file without "${name}"`);
  if (value > maximum) throw new DecodeError("limit", `has a file of more than ${maximum} ${name}`);
  return value;
}

/** The position in `files` of the file that holds a frame. */
export function fileOfFrame({ files }: SequenceIndex, frame: number): number {
  let [low, high] = [0, files.length - 1];
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if ((files[middle]?.first ?? 0) <= frame) low = middle;
    else high = middle - 1;
  }
  return low;
}
