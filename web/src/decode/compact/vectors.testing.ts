// Reads the files of vectors/compact-1 and vectors/compact-2, one folder for each version of the format
// (docs/formats/compact.md, "Conformance").

import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { inflateSync } from "node:zlib";
import type { DecodeError } from "../decodeError.ts";
import type { Version } from "./header.ts";
import type { CompactPatch } from "./patch.ts";
import { decodePatches } from "./patch.ts";

const folderOf = (version: Version): string => join(import.meta.dirname, `../../../../vectors/compact-${version}`);

/** The names of the files that hold patches. */
export function vectorNames(version: Version = 2): string[] {
  return readdirSync(folderOf(version))
    .filter((name) => name.endsWith(".png"))
    .map((name) => name.slice(0, -".png".length));
}

/** The content of NAME.json. */
export function readVector(name: string, version: Version = 2): unknown {
  return JSON.parse(readFileSync(join(folderOf(version), `${name}.json`), "utf8")) as unknown;
}

const payloads = new Map<string, Uint8Array<ArrayBuffer>>();

/** A copy of the pixels of NAME.png. Tests take thousands of each, so every file is read once. */
export function readPayload(name: string, version: Version = 2): Uint8Array<ArrayBuffer> {
  const key = `${version}/${name}`;
  const payload = payloads.get(key) ?? pixelsOf(name, version);
  payloads.set(key, payload);
  return payload.slice();
}

/** The pixels of NAME.png, which has one IDAT chunk and no filters. */
function pixelsOf(name: string, version: Version): Uint8Array<ArrayBuffer> {
  const png = readFileSync(join(folderOf(version), `${name}.png`));
  const width = png.readUInt32BE(16);
  const height = png.readUInt32BE(20);
  const data = png.indexOf("IDAT") + 4;
  const rows = inflateSync(png.subarray(data, data + png.readUInt32BE(data - 8)));
  const pixels = new Uint8Array(width * height);
  for (let y = 0; y < height; ++y) {
    if (rows[y * (width + 1)] !== 0) throw new Error(`${name}.png has a filter`);
    pixels.set(rows.subarray(y * (width + 1) + 1, (y + 1) * (width + 1)), y * width);
  }
  return pixels;
}

/** The patches of NAME.png. */
export function decodeVector(name: string, version: Version = 2): CompactPatch[] {
  return decodePatches(readPayload(name, version), (patch) => patch);
}

/** The bytes of NAME.png. */
export function readVectorFile(name: string, version: Version = 2): Uint8Array<ArrayBuffer> {
  return new Uint8Array(readFileSync(join(folderOf(version), `${name}.png`)));
}

/** An entry of edits.json: a damaged payload, and the verdict on it. */
export interface Edit {
  readonly file: string;
  /** Byte offsets, and the new values of the bytes. */
  readonly edits: [number, number][];
  /** The length to cut the payload to after that. */
  readonly length?: number;
  readonly verdict: number | DecodeError["kind"];
}

export function editedPayload({ file, edits, length }: Edit, version: Version): Uint8Array {
  const payload = readPayload(file, version);
  for (const [byteOffset, value] of edits) payload[byteOffset] = value;
  return payload.subarray(0, length);
}

/** An entry of refused.json: a payload that is refused. */
export interface Refused {
  readonly name: string;
  /** In hexadecimal. */
  readonly payload: string;
  readonly verdict: DecodeError["kind"];
}

export function payloadOfRefused({ payload }: Refused): Uint8Array {
  return Uint8Array.from(Buffer.from(payload, "hex"));
}
