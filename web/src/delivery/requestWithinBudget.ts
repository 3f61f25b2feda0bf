// What is asked for of all geometries and textures of a scene, within what they
// may take on the GPU together.

import type { GeometryDescription } from "../document/description.ts";
import { grantedRequests } from "../scheduler/budget.ts";
import type { FilePriority } from "./geometryDelivery.ts";
import type { GeometryDeliveries } from "./geometryDeliveries.ts";
import type { TextureDeliveries, TexturePriority } from "./textureDeliveries.ts";

export interface SceneDeliveries {
  readonly geometries: GeometryDeliveries;
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
export function requestWithinBudget(
  deliveries: SceneDeliveries,
  demandOf: (geometry: GeometryDescription) => FilePriority,
  textureDemand: TexturePriority,
  mostBytes = Infinity,
): void {
  const { geometries, textures } = deliveries;
  const granted =
    storedBytesOf(deliveries) > mostBytes
      ? grantedRequests([...geometries.budgetRequests(demandOf), ...textures.budgetRequests(textureDemand)], mostBytes)
      : undefined;
  geometries.request(demandOf, granted);
  textures.request(textureDemand, granted);
}
