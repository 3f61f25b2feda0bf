// The registry of encodings in delivery: one entry for each encoding.

import type { Encoding, GeometryDescription } from "../../document/description.ts";
import { bgDelivery } from "./bg/bgDelivery.ts";
import { classicDelivery } from "./classic/classicDelivery.ts";
import { compactDelivery } from "./compact/compactDelivery.ts";
import { liveDelivery } from "./live/liveDelivery.ts";
import type { EncodingDelivery } from "./encodingDelivery.ts";

export const encodingDeliveries: Readonly<Record<Encoding, EncodingDelivery>> = {
  compact: compactDelivery,
  classic: classicDelivery,
  bg: bgDelivery,
  live: liveDelivery,
};

export function deliveryOf({ encoding }: Pick<GeometryDescription, "encoding">): EncodingDelivery {
  return encodingDeliveries[encoding];
}

/** Whether workers decode the geometry's patches on every GPU, not only on those that cannot read images exactly. */
export function needsWorkers(geometry: GeometryDescription): boolean {
  return deliveryOf(geometry).needsWorkers(geometry);
}
