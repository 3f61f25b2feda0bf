// A geometry -> its stages. Asks for the files of its patches as it is told to,
// turns what comes into stages, and reports what does not come; one missing file
// costs what it holds and nothing else.

import type { Stage } from "../decode/stage.ts";
import type { GeometryDescription, PatchDescription } from "../document/description.ts";
import type { DeliveryError } from "./deliveryError.ts";
import { asDeliveryError } from "./deliveryError.ts";
import type { Part } from "./parts.ts";
import { partsOf } from "./parts.ts";
import type { Transfer } from "./progress.ts";
import type { ContentKind, Lease, ResourcePool } from "./resources.ts";
import { bgBuilder } from "./bgStage.ts";
import { compactBuilder } from "./compactStage.ts";
import { sigBuilder } from "./sigStage.ts";
import type { StageBuilder } from "./stageBuilder.ts";

export interface DeliveryListener {
  /** A newer stage of a patch; it takes the place of the one before as a whole. */
  onStage(patch: number, stage: Stage): void;
  /** Once for each file that is of no use. */
  onError(error: DeliveryError): void;
  /** Every file that was asked for has come or failed. Again after each demand that asked for more. */
  onSettled(): void;
}

/** The priority of a file that is wanted now; undefined: not now. */
export type Demand = (place: number, part: Part) => number | undefined;

export interface Delivery {
  /** Of the files that were asked for. */
  readonly transfers: readonly Readonly<Transfer>[];
  /** Every file that was asked for has come or failed. */
  readonly isSettled: boolean;
  /** There is nothing left that could be asked for. */
  readonly isExhausted: boolean;
  /** Asks for what is wanted, gives new priorities to what is on its way, and aborts what is no longer wanted. */
  demand(priorityOf: Demand): void;
  /** No call to the listener follows. Stages must no longer be used. */
  cancel(): void;
}

/** A file that a patch needs, and how far it is. */
interface Need {
  readonly place: number;
  readonly part: Part;
  readonly kind: ContentKind;
  readonly builder: StageBuilder;
  /** While it is asked for, and when it is here. */
  lease: Lease | undefined;
  state: "absent" | "asked" | "here" | "failed";
}

/** Asks for nothing before `demand`. Never calls the listener before it returns. */
export function deliver(geometry: GeometryDescription, pool: ResourcePool, listener: DeliveryListener): Delivery {
  return new GeometryDelivery(geometry, pool, listener);
}

class GeometryDelivery implements Delivery {
  readonly #pool: ResourcePool;
  readonly #listener: DeliveryListener;
  readonly #needs: readonly Need[];
  readonly #reported = new Set<string>();
  /** Undefined when leases have come or gone: there may be thousands of deliveries to ask. */
  #transfers: readonly Readonly<Transfer>[] | undefined;
  readonly #aborter = new AbortController();

  constructor(geometry: GeometryDescription, pool: ResourcePool, listener: DeliveryListener) {
    this.#pool = pool;
    this.#listener = listener;
    this.#needs = geometry.patches.flatMap((patch: PatchDescription, place) => {
      const builder = geometry.container === "bg" ? bgBuilder(geometry, patch)
        : geometry.container === "compact" ? compactBuilder(geometry, patch, pool.runJob, this.#aborter.signal)
        : sigBuilder(geometry, patch, pool.runJob, this.#aborter.signal);
      const kind = contentKindOf(geometry, patch, pool.largestTexture);
      return partsOf(geometry, patch).map((part): Need => ({ place, part, kind, builder, lease: undefined, state: "absent" }));
    });
  }

  get transfers(): readonly Readonly<Transfer>[] {
    this.#transfers ??= Array.from(new Set(this.#needs.flatMap(({ lease }) => (lease ? [lease.transfer] : []))));
    return this.#transfers;
  }

  get isSettled(): boolean {
    return this.#needs.every(({ state }) => state !== "asked");
  }

  get isExhausted(): boolean {
    return this.#needs.every(({ state }) => state === "here" || state === "failed");
  }

  demand(priorityOf: Demand): void {
    for (const need of this.#needs) {
      if (need.state === "here" || need.state === "failed") continue;
      const priority = priorityOf(need.place, need.part);
      if (priority === undefined) this.#giveUp(need);
      else if (need.lease !== undefined) need.lease.setPriority(priority);
      else this.#ask(need, priority);
    }
  }

  cancel(): void {
    this.#aborter.abort();
    for (const { lease } of this.#needs) lease?.release();
  }

  #ask(need: Need, priority: number): void {
    const { reference, expectedBytes } = need.part;
    const lease = this.#pool.lease({ kind: need.kind, url: reference.url, priority, expectedBytes });
    need.lease = lease;
    need.state = "asked";
    this.#transfers = undefined;
    void this.#await(need, lease);
  }

  #giveUp(need: Need): void {
    if (need.lease === undefined) return;
    need.lease.release();
    need.lease = undefined;
    need.state = "absent";
    this.#transfers = undefined;
  }

  async #await(need: Need, lease: Lease): Promise<void> {
    // Given up in between, or given up and asked for again.
    const isOver = () => this.#aborter.signal.aborted || need.lease !== lease;
    try {
      const content = await lease.content;
      if (isOver()) return;
      await need.builder.accept(need.part, content);
      if (isOver()) return;
      need.state = "here";
      const stage = need.builder.stage();
      if (stage !== undefined) this.#listener.onStage(need.place, stage);
    } catch (error) {
      if (isOver()) return;
      need.state = "failed";
      this.#report(need.part.reference.url, error);
    }
    if (this.isSettled) this.#listener.onSettled();
  }

  #report(url: string, error: unknown): void {
    if (this.#reported.has(url)) return;
    this.#reported.add(url);
    this.#listener.onError(asDeliveryError(error, url));
  }
}

/** Where the vertices of a patch are to be decoded, and so what its files are to become. */
function contentKindOf(geometry: GeometryDescription, patch: PatchDescription, largestTexture: number): ContentKind {
  if (geometry.container === "compact") return "payload";
  if (geometry.container === "bg" || geometry.decode === "cpu") return "bytes";
  if (geometry.decode === "gpu") return "texture";
  const texels = patch.grid ? patch.vertexCount : patch.draws.reduce((sum, draw) => sum + draw.count, 0);
  const edge = Math.max(patch.implicitWidth, Math.ceil(texels / patch.implicitWidth));
  return edge > largestTexture ? "bytes" : "either";
}
