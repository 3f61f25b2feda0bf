// An encoder of frames for tests (docs/formats/frame.md): gzip at level 1.

import { crc32, gzipSync } from "node:zlib";
import type { FrameHeader, Prediction } from "./frameHeader.ts";
import { componentRunsOf, frameHeaderBytes, predictions, unpackedBytesOf } from "./frameHeader.ts";

export function encodeFrame(
  header: Omit<FrameHeader, "packedBytes" | "isDifference">,
  components: readonly ArrayLike<number>[],
): Uint8Array<ArrayBuffer> {
  const { vertices, prediction, columns } = header;
  const unpacked = new Uint8Array(unpackedBytesOf(header));
  let at = 0;
  let component = 0;
  for (const { count, bits } of componentRunsOf(header)) {
    const byteCount = Math.ceil(bits / 8);
    const residuals = Array.from({ length: count }, (_, n) =>
      residualsOf(components[component + n] ?? [], prediction, columns, bits),
    );
    for (let byte = byteCount - 1; byte >= 0; --byte)
      for (const plane of residuals)
        for (let vertex = 0; vertex < vertices; ++vertex) unpacked[at++] = ((plane[vertex] ?? 0) >>> (8 * byte)) & 255;
    component += count;
  }
  const packed = gzipSync(unpacked, { level: 1 });
  const bytes = new Uint8Array(frameHeaderBytes + packed.length);
  const view = new DataView(bytes.buffer);
  bytes.set([0x49, 0x47, 0x46, 1]);
  view.setUint32(4, packed.length, true);
  view.setBigUint64(8, BigInt(header.number), true);
  view.setBigUint64(16, BigInt(header.epoch), true);
  view.setFloat64(24, header.time, true);
  view.setUint32(32, vertices, true);
  view.setUint32(36, columns, true);
  bytes.set(
    [
      header.positionBits,
      header.normalBits,
      header.colorComponents,
      header.valueComponents,
      header.valueBits,
      predictions.indexOf(prediction),
    ],
    40,
  );
  view.setUint32(48, crc32(bytes.subarray(0, 48)), true);
  bytes.set(packed, frameHeaderBytes);
  return bytes;
}

function residualsOf(values: ArrayLike<number>, prediction: Prediction, columns: number, bits: number): Uint32Array {
  const at = (n: number) => values[n] ?? 0;
  const predicted = (n: number): number => {
    const [left, above] = [n % columns > 0, n >= columns];
    switch (prediction) {
      case "none":
        return 0;
      case "previous":
        return at(n - 1);
      case "linear":
        return n === 1 ? at(0) : 2 * at(n - 1) - at(n - 2);
      case "planar":
        if (left && above) return at(n - 1) + at(n - columns) - at(n - columns - 1);
        return left ? at(n - 1) : above ? at(n - columns) : 0;
    }
  };
  return Uint32Array.from({ length: values.length }, (_, n) => {
    // The difference as a number of `bits` bits with a sign.
    const difference = ((at(n) - predicted(n)) << (32 - bits)) >> (32 - bits);
    return ((difference << 1) ^ (difference >> 31)) & (2 ** bits - 1);
  });
}
