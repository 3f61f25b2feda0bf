// Kinds of deliveries that few scenes need. Their modules add them here before the first geometry of the kind is
// delivered (document/parts.ts).

import type { GeometryDescription, LevelsDescription, SequenceDescription } from "../document/description.ts";
import type { MovingGeometry } from "../document/movingGeometry.ts";
import type { Delivery, DeliveryListener } from "./geometryDelivery.ts";
import type { ResourcePool } from "./resourcePool.ts";

/** Where a sequence is: a part of its duration, 0 … 1, or seconds from its beginning. */
export type SequencePosition = { readonly fraction: number } | { readonly seconds: number };

/** The delivery of a sequence. */
export interface PlayedDelivery extends Delivery {
  /** In seconds; 0 before the index has arrived. */
  readonly duration: number;
  setPosition(position: SequencePosition): void;
}

export interface LateDeliveries {
  readonly moving: (
    geometry: GeometryDescription,
    moving: MovingGeometry,
    pool: ResourcePool,
    listener: DeliveryListener,
  ) => Delivery;
  readonly stream: (geometry: GeometryDescription, pool: ResourcePool, listener: DeliveryListener) => Delivery;
  readonly levels: (
    geometry: GeometryDescription,
    levels: LevelsDescription,
    pool: ResourcePool,
    listener: DeliveryListener,
  ) => Delivery;
  readonly sequence: (
    geometry: GeometryDescription,
    sequence: SequenceDescription,
    pool: ResourcePool,
    listener: DeliveryListener,
  ) => PlayedDelivery;
}

const added: Partial<LateDeliveries> = {};

export function addDeliveries(deliveries: Partial<LateDeliveries>): void {
  Object.assign(added, deliveries);
}

/** Throws RangeError where the module of this kind has not been loaded. */
export function lateDelivery<Kind extends keyof LateDeliveries>(kind: Kind): LateDeliveries[Kind] {
  const deliver = added[kind];
  if (deliver === undefined) throw new RangeError(`the module for deliveries of the kind "${kind}" is not loaded`);
  return deliver;
}
