// The header of a frame of a live stream (docs/formats/frame.md).

import { crc32 } from "../crc32.ts";
import { DecodeError } from "../decodeError.ts";
import { maxDeflateRatio } from "../inflate.ts";

/** How the vertices of frames are stored. It is the same for all frames of an epoch. */
export interface FrameLayout {
  /** 1 … 2²². */
  readonly vertices: number;
  /** Vertices in a row of the grid; 0: the vertices are no grid. */
  readonly columns: number;
  /** Bits of a coordinate: 8 … 24. */
  readonly positionBits: number;
  /** Bits of each of the two numbers of an octahedral normal, 8 … 16; 0: no normals. */
  readonly normalBits: number;
  /** 3 (RGB) or 4 (RGBA), 8 bits each; 0: no colours. */
  readonly colorComponents: number;
  /** 1 … 4; 0: no values. */
  readonly valueComponents: number;
  /** 8 … 24; 0 where there are no values. */
  readonly valueBits: number;
}

export const predictions = ["none", "previous", "linear", "planar"] as const;
export type Prediction = (typeof predictions)[number];

export interface FrameHeader extends FrameLayout {
  /** Consecutive in a stream; below 2⁵³. */
  readonly number: number;
  /** The number of the first frame with this layout and lattice. */
  readonly epoch: number;
  /** Seconds of the publisher's clock. */
  readonly time: number;
  readonly prediction: Prediction;
  /** Its integers are differences to those of the frame before: only in sequences. */
  readonly isDifference: boolean;
  /** Length of the gzip stream behind the header. */
  readonly packedBytes: number;
}

export const frameHeaderBytes = 52;
/** The bit that marks a difference in the byte with the prediction, in frames of sequences. */
const differenceBit = 4;
export const maxFrameVertices = 2 ** 22;
export const maxUnpackedBytes = 2 ** 26;

/** A run of components of one attribute, with their bits. */
export interface ComponentRun {
  readonly attribute: "position" | "normal" | "color" | "value";
  readonly count: number;
  readonly bits: number;
}

/** The components of a vertex, in their order. */
export function componentRunsOf(layout: FrameLayout): readonly ComponentRun[] {
  const { positionBits, normalBits, colorComponents, valueComponents, valueBits } = layout;
  const runs: ComponentRun[] = [
    { attribute: "position", count: 3, bits: positionBits },
    { attribute: "normal", count: normalBits > 0 ? 2 : 0, bits: normalBits },
    { attribute: "color", count: colorComponents, bits: 8 },
    { attribute: "value", count: valueComponents, bits: valueBits },
  ];
  return runs.filter(({ count }) => count > 0);
}

export function unpackedBytesOf(layout: FrameLayout): number {
  const bytes = componentRunsOf(layout).reduce((sum, { count, bits }) => sum + count * Math.ceil(bits / 8), 0);
  return layout.vertices * bytes;
}

/** Whether frames may have this layout, apart from the limits of their size. */
export function isLayout(layout: FrameLayout): boolean {
  const { vertices, columns, positionBits, normalBits, colorComponents, valueComponents, valueBits } = layout;
  const isIn = (value: number, min: number, max: number) => Number.isInteger(value) && value >= min && value <= max;
  return (
    isIn(vertices, 1, 2 ** 32) &&
    isIn(columns, 0, vertices) &&
    (columns === 0 || vertices % columns === 0) &&
    isIn(positionBits, 8, 24) &&
    (normalBits === 0 || isIn(normalBits, 8, 16)) &&
    (colorComponents === 0 || isIn(colorComponents, 3, 4)) &&
    isIn(valueComponents, 0, 4) &&
    (valueComponents === 0 ? valueBits === 0 : isIn(valueBits, 8, 24))
  );
}

/**
 * Reads and checks the header and the length of a frame, without unpacking it. Safe for untrusted bytes. Throws
 * DecodeError. `isOfSequence`: it may be a difference (docs/formats/sequence.md).
 */
export function readFrameHeader(bytes: Uint8Array, isOfSequence = false): FrameHeader {
  if (bytes.length < frameHeaderBytes) throw new DecodeError("truncated", "is shorter than the header of a frame");
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (String.fromCharCode(...bytes.subarray(0, 3)) !== "IGF") throw new DecodeError("malformed", "is no frame");
  if (bytes[3] !== 1) throw new DecodeError("unsupported", `is a frame of version ${bytes[3] ?? 0}; 1 is read`);
  if (crc32(bytes.subarray(0, 48)) !== view.getUint32(48, true))
    throw new DecodeError("malformed", "has a damaged header");
  const isDifference = isOfSequence && (view.getUint8(45) & differenceBit) !== 0;
  const prediction = predictions[view.getUint8(45) - (isDifference ? differenceBit : 0)];
  const header = {
    packedBytes: view.getUint32(4, true),
    number: Number(view.getBigUint64(8, true)),
    epoch: Number(view.getBigUint64(16, true)),
    time: view.getFloat64(24, true),
    vertices: view.getUint32(32, true),
    columns: view.getUint32(36, true),
    positionBits: view.getUint8(40),
    normalBits: view.getUint8(41),
    colorComponents: view.getUint8(42),
    valueComponents: view.getUint8(43),
    valueBits: view.getUint8(44),
    prediction: prediction ?? "none",
    isDifference,
  };
  const isValid =
    isLayout(header) &&
    header.number < 2 ** 53 &&
    header.epoch <= header.number &&
    Number.isFinite(header.time) &&
    prediction !== undefined &&
    (prediction !== "planar" || header.columns > 0) &&
    view.getUint16(46) === 0;
  if (!isValid) throw new DecodeError("malformed", "has a header with a number out of its range");
  const unpackedBytes = unpackedBytesOf(header);
  if (header.vertices > maxFrameVertices || unpackedBytes > maxUnpackedBytes)
    throw new DecodeError("limit", `has ${header.vertices} vertices in ${unpackedBytes} bytes`);
  const following = bytes.length - frameHeaderBytes;
  if (following < header.packedBytes) throw new DecodeError("truncated", "is cut");
  if (following > header.packedBytes) throw new DecodeError("malformed", "goes on after its end");
  if (unpackedBytes > maxDeflateRatio * header.packedBytes)
    throw new DecodeError("malformed", "is too short for the vertices in its header");
  return header;
}
