// Frames with damage that their checksums hide, so that it reaches what these protect.

import { crc32, gunzipSync, gzipSync } from "node:zlib";
import type { TestRandom } from "../web/src/decode/compact/rangeEncoder.testing.ts";
import { frameHeaderBytes } from "../web/src/decode/frame/frameHeader.ts";
import { damaged } from "./verdicts.testing.ts";

export type Bytes = Uint8Array<ArrayBuffer>;

/** The bytes with a matching checksum and length in the header, so that damage reaches what they protect. */
export function withChecksum(bytes: Bytes): Bytes {
  if (bytes.length < frameHeaderBytes) return bytes;
  const fixed = bytes.slice();
  const view = new DataView(fixed.buffer);
  fixed.set([0x49, 0x47, 0x46, 1]);
  view.setUint32(4, fixed.length - frameHeaderBytes, true);
  view.setUint32(48, crc32(fixed.subarray(0, 48)), true);
  return fixed;
}

/** The frame with damaged planes, packed again. */
export function withDamagedPlanes(frame: Bytes, other: Bytes, random: TestRandom): Bytes {
  const planes = damaged(Uint8Array.from(gunzipSync(frame.subarray(frameHeaderBytes))), other, random);
  return withChecksum(Uint8Array.from([...frame.subarray(0, frameHeaderBytes), ...gzipSync(planes, { level: 1 })]));
}
