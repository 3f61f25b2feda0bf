// The registry of encodings in delivery: one entry for each encoding. Modules that few scenes need add theirs before the
// first geometry in it is delivered (document/parts.ts).

import type { Encoding, GeometryDescription } from "../../document/description.ts";
import { compactDelivery } from "./compact/compactDelivery.ts";
import type { EncodingDelivery } from "./encodingDelivery.ts";

const encodingDeliveries: Partial<Record<Encoding, EncodingDelivery>> = { compact: compactDelivery };

export function addEncodings(deliveries: Partial<Record<Encoding, EncodingDelivery>>): void {
  Object.assign(encodingDeliveries, deliveries);
}

/** Throws RangeError where the module of the encoding has not been loaded. */
export function deliveryOf({ encoding }: Pick<GeometryDescription, "encoding">): EncodingDelivery {
  const delivery = encodingDeliveries[encoding];
  if (delivery === undefined) throw new RangeError(`the module for the encoding "${encoding}" is not loaded`);
  return delivery;
}

/** Whether workers decode the geometry's patches on every GPU, not only on those that cannot read images exactly. */
export function needsWorkers(geometry: GeometryDescription): boolean {
  return deliveryOf(geometry).needsWorkers(geometry);
}
