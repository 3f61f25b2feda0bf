// Decodes a frame of a live stream to the stored integers of its vertices (docs/formats/frame.md). src/live/frame.h
// does the same; vectors/frame-1 binds both.

import { DecodeError } from "../decodeError.ts";
import { inflate } from "../inflate.ts";
import type { FrameHeader, Prediction } from "./frameHeader.ts";
import { componentRunsOf, frameHeaderBytes, readFrameHeader, unpackedBytesOf } from "./frameHeader.ts";

export interface Frame {
  readonly header: FrameHeader;
  /** The stored integers, one array for each component, in the order of `componentRunsOf`. */
  readonly components: readonly Uint32Array<ArrayBuffer>[];
}

/** Rejects with DecodeError. Safe for untrusted bytes; allocates memory in proportion to what they can unpack to. */
export async function decodeFrame(bytes: Uint8Array<ArrayBuffer>): Promise<Frame> {
  return await decode(bytes, readFrameHeader(bytes));
}

/** Decodes a frame of a sequence. `before`: the components of the frame before it; undefined: there is none. */
export async function decodeFrameAfter(
  bytes: Uint8Array<ArrayBuffer>,
  before: Frame["components"] | undefined,
): Promise<Frame> {
  const header = readFrameHeader(bytes, true);
  if (!header.isDifference) return decode(bytes, header);
  const runs = componentRunsOf(header);
  const isLayoutOfBefore =
    before?.length === runs.reduce((sum, { count }) => sum + count, 0) &&
    before.every(({ length }) => length === header.vertices);
  if (!isLayoutOfBefore) throw new DecodeError("malformed", "is a difference to a frame that is not there");
  const frame = await decode(bytes, header);
  let component = 0;
  for (const { count, bits } of runs)
    for (const end = component + count; component < end; ++component)
      addBefore(frame.components[component], before[component], 2 ** bits - 1);
  return frame;
}

function addBefore(values: Uint32Array | undefined, before: Uint32Array | undefined, mask: number): void {
  if (values === undefined || before === undefined) return;
  for (let n = 0; n < values.length; ++n) values[n] = ((values[n] ?? 0) + (before[n] ?? 0)) & mask;
}

async function decode(bytes: Uint8Array<ArrayBuffer>, header: FrameHeader): Promise<Frame> {
  const unpacked = await unpack(bytes.subarray(frameHeaderBytes), unpackedBytesOf(header));
  const { vertices } = header;
  const components: Uint32Array<ArrayBuffer>[] = [];
  let first = 0;
  for (const { count, bits } of componentRunsOf(header)) {
    const byteCount = Math.ceil(bits / 8);
    for (let component = 0; component < count; ++component) {
      const values = new Uint32Array(vertices);
      for (let byte = 0; byte < byteCount; ++byte) {
        const plane = first + (byte * count + component) * vertices;
        for (let vertex = 0; vertex < vertices; ++vertex)
          values[vertex] = ((values[vertex] ?? 0) << 8) | (unpacked[plane + vertex] ?? 0);
      }
      addPredictions(values, header.prediction, header.columns, 2 ** bits - 1);
      components.push(values);
    }
    first += byteCount * count * vertices;
  }
  return { header, components };
}

function unpack(packed: Uint8Array<ArrayBuffer>, length: number): Promise<Uint8Array> {
  // The stream ends in the length that it unpacks to, so that bytes behind it are noticed.
  const view = new DataView(packed.buffer, packed.byteOffset, packed.byteLength);
  if (packed.length < 4 || view.getUint32(packed.length - 4, true) !== length)
    throw new DecodeError("malformed", "is packed from another number of bytes");
  return inflate([packed], length, "gzip");
}

/** Replaces the residuals of one component by its values. `mask`: the bits that a value has. */
function addPredictions(values: Uint32Array, prediction: Prediction, columns: number, mask: number): void {
  // Elements before the first read as undefined, and `| 0` makes them 0.
  const at = (n: number) => (values[n] ?? 0) | 0;
  const set = (n: number, predicted: number) => {
    const residual = at(n);
    values[n] = (predicted + ((residual >>> 1) ^ -(residual & 1))) & mask;
  };
  const count = values.length;
  switch (prediction) {
    case "none":
      for (let n = 0; n < count; ++n) set(n, 0);
      return;
    case "previous":
      for (let n = 0; n < count; ++n) set(n, at(n - 1));
      return;
    case "linear":
      for (let n = 0; n < count; ++n) set(n, n === 1 ? at(0) : 2 * at(n - 1) - at(n - 2));
      return;
    case "planar":
      for (let n = 0; n < Math.min(columns, count); ++n) set(n, at(n - 1));
      for (let first = columns; first < count; first += columns) {
        set(first, at(first - columns));
        for (let n = first + 1; n < first + columns; ++n) set(n, at(n - 1) + at(n - columns) - at(n - columns - 1));
      }
  }
}
