// What both stage builders of classic read: fields of descriptions, and the available byte planes.

import { DecodeError } from "../../../decode/decodeError.ts";
import type { GeometryDescription, Reference } from "../../../document/description.ts";
import { isPair } from "../../../document/description.ts";
import type { NormalFormat } from "../../../stage/stage.ts";

export function normalFormatOf({ normalEncoding, normalBits }: GeometryDescription): NormalFormat {
  return isPair(normalEncoding) ? { kind: normalEncoding, bits: normalBits } : { kind: "byteVector" };
}

export function firstTexelOf(reference: Reference): number {
  if ("firstTexel" in reference) return reference.firstTexel;
  throw new DecodeError("malformed", "is referenced without a first texel");
}

/** The available planes before the first missing one: a plane is useful only together with all above it. */
export function leadingPlanes<Plane>(planes: readonly (Plane | undefined)[]): Plane[] {
  const dense = Array.from(planes); // `indexOf` skips the holes of a sparse array
  const missing = dense.indexOf(undefined);
  return dense.slice(0, missing < 0 ? undefined : missing).filter((plane) => plane !== undefined);
}
