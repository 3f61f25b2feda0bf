// Fields of a geometry description that both stage builders of classic read.

import { DecodeError } from "../../../decode/decodeError.ts";
import type { GeometryDescription, Reference } from "../../../document/description.ts";
import { isPair } from "../../../document/geometry.ts";
import type { NormalFormat } from "../../../stage/stage.ts";

export function normalFormatOf({ normalEncoding }: GeometryDescription): NormalFormat {
  return isPair(normalEncoding) ? { kind: normalEncoding, bits: 8 } : { kind: "byteVector" };
}

export function firstTexelOf(reference: Reference): number {
  if ("firstTexel" in reference) return reference.firstTexel;
  throw new DecodeError("malformed", "is referenced without a first texel");
}
