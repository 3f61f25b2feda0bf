// What is asked for of all geometries and textures of a scene, within what they
// may take on the GPU together.

import type { GeometryDescription } from "../document/description.ts";
import { grantedOf } from "../scheduler/budget.ts";
import type { Demand } from "./deliver.ts";
import type { SharedDeliveries } from "./sharedDeliveries.ts";
import type { TextureDeliveries, TextureDemand } from "./textureDeliveries.ts";

export interface SceneDeliveries {
  readonly geometries: SharedDeliveries;
  readonly textures: TextureDeliveries;
}

/** What they would take on the GPU, as far as is known; what several share counts for each. */
export function storedBytesOf({ geometries, textures }: SceneDeliveries): number {
  return geometries.storedBytes + textures.storedBytes;
}

/**
 * Says what is wanted, for all who show it. Where all of it would take more than
 * `mostBytes` on the GPU, what matters most is asked for, and what matters less than
 * that is given up.
 */
export function demandWithin(
  deliveries: SceneDeliveries,
  demandOf: (geometry: GeometryDescription) => Demand,
  textureDemand: TextureDemand,
  mostBytes = Infinity,
): void {
  const { geometries, textures } = deliveries;
  const granted =
    storedBytesOf(deliveries) > mostBytes
      ? grantedOf([...geometries.claims(demandOf), ...textures.claims(textureDemand)], mostBytes)
      : undefined;
  geometries.demand(demandOf, granted);
  textures.demand(textureDemand, granted);
}
