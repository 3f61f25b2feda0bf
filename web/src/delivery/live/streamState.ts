// Reads `latest` of a live stream (docs/live.md): what all its frames have in common, and the newest number.

import { DecodeError } from "../../decode/decodeError.ts";
import type { FrameLayout } from "../../decode/frame/frameHeader.ts";
import { isLayout, maxFrameVertices } from "../../decode/frame/frameHeader.ts";
import type { Box3, Vec3 } from "../../document/description.ts";

export interface StreamState extends FrameLayout {
  /** The number of the first frame with this layout and lattice. */
  readonly epoch: number;
  /** The newest frame; undefined before the first. */
  readonly number: number | undefined;
  /** The number that comes next. */
  readonly next: number;
  /** When the server had the newest frame, in milliseconds of its clock; undefined before the first. */
  readonly addedAt: number | undefined;
  /** The server's clock when it answered. */
  readonly now: number;
  /** Whether a cache shares frames among viewers, who request each frame when it is there. */
  readonly isTimed: boolean;
  /** Frames per second that the publisher announces; 0: none. */
  readonly rate: number;
  readonly hasEnded: boolean;
  /** A stored integer v is the coordinate origin + v * step. */
  readonly origin: Vec3;
  readonly step: number;
  /** All frames of the epoch lie in it. */
  readonly box: Box3;
  /** Minimum and maximum of each component of the values. */
  readonly valueRange: readonly (readonly [number, number])[];
}

/** Checks untrusted text. Throws DecodeError. */
export function readStreamState(text: string): StreamState {
  const json = objectOf(text);
  const number = (name: string, value: unknown = json[name]): number => {
    if (typeof value !== "number" || !Number.isFinite(value))
      throw new DecodeError("malformed", `states no number as "${name}"`);
    return value;
  };
  const frameNumber = (name: string): number => {
    const value = number(name);
    if (!Number.isSafeInteger(value) || value < 0)
      throw new DecodeError("malformed", `states no frame number as "${name}"`);
    return value;
  };
  const vector = (name: string, value: unknown = json[name]): Vec3 => {
    const [x, y, z] = Array.isArray(value) ? (value as unknown[]) : [];
    return [number(name, x), number(name, y), number(name, z)];
  };
  const layout: FrameLayout = {
    vertices: number("vertices"),
    columns: number("columns"),
    positionBits: number("positionBits"),
    normalBits: number("normalBits"),
    colorComponents: number("colorComponents"),
    valueComponents: number("valueComponents"),
    valueBits: number("valueBits"),
  };
  if (!isLayout(layout) || layout.vertices > maxFrameVertices)
    throw new DecodeError("malformed", "states vertices that no frame can have");
  const step = number("step");
  if (!(step > 0)) throw new DecodeError("malformed", 'states a "step" that is not positive');
  const [min, max] = Array.isArray(json.box) ? (json.box as unknown[]) : [];
  const ranges = Array.isArray(json.valueRange) ? (json.valueRange as unknown[]) : [];
  return {
    ...layout,
    epoch: frameNumber("epoch"),
    number: json.number === null ? undefined : frameNumber("number"),
    next: frameNumber("next"),
    addedAt: typeof json.added === "number" ? json.added : undefined,
    now: json.now === undefined ? 0 : number("now"),
    isTimed: json.timed === true,
    rate: Math.max(0, number("rate")),
    hasEnded: json.ended === true,
    origin: vector("origin"),
    step,
    box: { min: vector("box", min), max: vector("box", max) },
    valueRange: Array.from({ length: layout.valueComponents }, (_, component) => {
      const range = ranges[component];
      const [low, high] = Array.isArray(range) ? (range as unknown[]) : [];
      return [number("valueRange", low), number("valueRange", high)] as const;
    }),
  };
}

function objectOf(text: string): Readonly<Record<string, unknown>> {
  let json: unknown;
  try {
    json = JSON.parse(text);
  } catch {
    throw new DecodeError("malformed", "is no JSON");
  }
  if (typeof json !== "object" || json === null) throw new DecodeError("malformed", "is no description of a stream");
  return json as Readonly<Record<string, unknown>>;
}
