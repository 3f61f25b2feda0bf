// A geometry -> its stages. Leases the files of every patch, turns what comes
// into stages, and reports what does not come; one missing file costs what it
// holds and nothing else.

import type { Stage } from "../decode/stage.ts";
import type { GeometryDescription, PatchDescription } from "../document/description.ts";
import type { DeliveryError } from "./deliveryError.ts";
import { asDeliveryError } from "./deliveryError.ts";
import type { Part } from "./parts.ts";
import { partsOf } from "./parts.ts";
import type { Transfer } from "./progress.ts";
import type { Lease, ResourcePool } from "./resources.ts";
import { bgBuilder } from "./bgStage.ts";
import { sigBuilder } from "./sigStage.ts";
import type { StageBuilder } from "./stageBuilder.ts";

export interface DeliveryListener {
  /** A newer stage of a patch; it takes the place of the one before as a whole. */
  onStage(patch: number, stage: Stage): void;
  /** Once for each file that is of no use. */
  onError(error: DeliveryError): void;
  /** Every file has come or failed. */
  onSettled(): void;
}

export interface Delivery {
  readonly transfers: readonly Readonly<Transfer>[];
  /** No call to the listener follows. Stages must no longer be used. */
  cancel(): void;
}

/** Never calls the listener before it returns. */
export function deliver(geometry: GeometryDescription, pool: ResourcePool, listener: DeliveryListener): Delivery {
  const leases: Lease[] = [];
  const reported = new Set<string>();
  let isCancelled = false;

  const onPart = (patch: number, part: Part, builder: StageBuilder, lease: Lease): Promise<void> =>
    lease.content.then((content) => {
      if (isCancelled) return;
      builder.accept(part, content);
      const stage = builder.stage();
      if (stage !== undefined) listener.onStage(patch, stage);
    }).catch((error: unknown) => {
      const { url } = part.reference;
      if (isCancelled || reported.has(url)) return;
      reported.add(url);
      listener.onError(asDeliveryError(error, url));
    });

  const arrivals = geometry.patches.flatMap((patch: PatchDescription, place) => {
    const builder = (geometry.container === "sig" ? sigBuilder : bgBuilder)(geometry, patch);
    return partsOf(geometry, patch).map((part) => {
      const lease = pool.lease({
        kind: geometry.container === "sig" ? "image" : "bytes",
        url: part.reference.url, priority: part.priority, expectedBytes: part.expectedBytes,
      });
      leases.push(lease);
      return onPart(place, part, builder, lease);
    });
  });
  void Promise.all(arrivals).then(() => {
    if (!isCancelled) listener.onSettled();
  });

  return {
    transfers: Array.from(new Set(leases.map((lease) => lease.transfer))),
    cancel() {
      isCancelled = true;
      for (const lease of leases) lease.release();
    },
  };
}
