// Requests the files of all geometries and textures of a scene, within the GPU memory that they may take together.

import type { GeometryDescription } from "../document/description.ts";
import { grantedRequests } from "../scheduler/budget.ts";
import type { GeometryView } from "./geometryView.ts";
import type { FilePriority } from "./geometryDelivery.ts";
import type { GeometryDeliveries } from "./geometryDeliveries.ts";
import type { TextureDeliveries, TexturePriority } from "./textureDeliveries.ts";

export interface SceneDeliveries {
  readonly geometries: GeometryDeliveries;
  readonly textures: TextureDeliveries;
}

/** Estimated bytes on the GPU; files that several geometries share count for each. */
export function storedBytesOf({ geometries, textures }: SceneDeliveries): number {
  return geometries.storedBytes + textures.storedBytes;
}

/**
 * Updates the priorities of all files. Where all of them would take more than `maxBytes` on the GPU, only the most
 * important are requested and the rest is evicted. `levels`: how levels of detail are seen, and the GPU memory of all
 * files beyond which they are not refined.
 */
export function requestWithinBudget(
  deliveries: SceneDeliveries,
  priorityOf: (geometry: GeometryDescription) => FilePriority,
  texturePriority: TexturePriority,
  maxBytes = Infinity,
  levels?: { readonly viewOf: (geometry: GeometryDescription) => GeometryView; readonly maxBytes: number },
): void {
  const { geometries, textures } = deliveries;
  if (levels) geometries.followViews(levels.viewOf, levels.maxBytes - textures.storedBytes);
  const granted =
    storedBytesOf(deliveries) > maxBytes
      ? grantedRequests(
          [...geometries.budgetRequests(priorityOf), ...textures.budgetRequests(texturePriority)],
          maxBytes,
        )
      : undefined;
  geometries.request(priorityOf, granted);
  textures.request(texturePriority, granted);
}
