// What frames of a stream or a sequence have in common, as JSON (docs/live.md, docs/formats/sequence.md).

import { DecodeError } from "../decodeError.ts";
import type { FrameLayout } from "./frameHeader.ts";
import { isLayout, maxFrameVertices } from "./frameHeader.ts";

type Vec3 = readonly [number, number, number];

export interface FrameDescription extends FrameLayout {
  /** Frames per second; 0: not stated. */
  readonly rate: number;
  /** A stored integer v is the coordinate origin + v * step. */
  readonly origin: Vec3;
  readonly step: number;
  /** All frames lie in it. */
  readonly box: { readonly min: Vec3; readonly max: Vec3 };
  /** Minimum and maximum of each component of the values. */
  readonly valueRange: readonly (readonly [number, number])[];
}

/** Whether frames of both have the same layout, lattice, box and ranges; their rates may differ. */
export function isSameDescription(a: FrameDescription, b: FrameDescription): boolean {
  return textOf(a) === textOf(b);
}

function textOf(description: FrameDescription): string {
  const { vertices, columns, positionBits, normalBits, colorComponents, valueComponents, valueBits } = description;
  const { origin, step, box, valueRange } = description;
  const layout = [vertices, columns, positionBits, normalBits, colorComponents, valueComponents, valueBits];
  return JSON.stringify([layout, origin, step, box.min, box.max, valueRange]);
}

export type JsonObject = Readonly<Record<string, unknown>>;

/** Throws DecodeError. */
export function objectIn(text: string, what: string): JsonObject {
  let json: unknown;
  try {
    json = JSON.parse(text);
  } catch {
    throw new DecodeError("malformed", "is no JSON");
  }
  if (typeof json !== "object" || json === null) throw new DecodeError("malformed", `is no ${what}`);
  return json as JsonObject;
}

/** Throws DecodeError unless the value is a finite number. */
export function numberIn(json: JsonObject, name: string, value: unknown = json[name]): number {
  if (typeof value !== "number" || !Number.isFinite(value))
    throw new DecodeError("malformed", `states no number as "${name}"`);
  return value;
}

/** Throws DecodeError. */
export function readFrameDescription(json: JsonObject): FrameDescription {
  const number = (name: string, value: unknown = json[name]): number => numberIn(json, name, value);
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
    rate: Math.max(0, number("rate")),
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
