// A geometry -> its stages. Asks for the files of its patches as it is told to,
// turns what comes into stages, and reports what does not come; one missing file
// costs what it holds and nothing else. What it has it gives up when it is told
// to, and asks for again.

import type { Stage } from "../stage/stage.ts";
import type { GeometryDescription, PatchDescription } from "../document/description.ts";
import type { BudgetRequest } from "../scheduler/budget.ts";
import type { DeliveryError } from "./deliveryError.ts";
import { asDeliveryError } from "./deliveryError.ts";
import type { PatchFile } from "./patchFiles.ts";
import { bytesPerTexel } from "./patchFiles.ts";
import type { Transfer } from "./progress.ts";
import type { Content, ResourceHandle, ResourcePool } from "./resourcePool.ts";
import { deliveryOf } from "./encodings/encodings.ts";
import type { StageBuilder } from "./stageBuilder.ts";

export interface DeliveryListener {
  /** Another stage of a patch; it takes the place of the one before as a whole. Undefined: nothing is left of the patch. */
  onStage(patch: number, stage: Stage | undefined): void;
  /** Once for each file that is of no use. */
  onError(error: DeliveryError): void;
  /** Every file that was asked for has come or failed. Again after each demand that asked for more. */
  onSettled(): void;
}

/** The priority of a file that is wanted now; undefined: not now. */
export type FilePriority = (place: number, part: PatchFile) => number | undefined;

export interface Delivery {
  /** Of the files that were asked for. */
  readonly transfers: readonly Readonly<Transfer>[];
  /** Every file that was asked for has come or failed. */
  readonly isSettled: boolean;
  /** There is nothing left that could be asked for. */
  readonly isExhausted: boolean;
  /** What all of it takes on the GPU, as far as that is known. */
  readonly storedBytes: number;
  /** What it wants, and has, of the GPU: for each patch in the order of use. */
  budgetRequests(priorityOf: FilePriority): readonly (readonly BudgetRequest[])[];
  /**
   * Asks for what is wanted, gives new priorities to what is on its way, and aborts
   * what is no longer wanted. What is here stays, but of claims only what is granted.
   */
  request(priorityOf: FilePriority, granted?: ReadonlySet<BudgetRequest>): void;
  /** No call to the listener follows. Stages must no longer be used. */
  cancel(): void;
}

/** A file that a patch needs, and how far it is. */
interface Need {
  readonly part: PatchFile;
  /** While it is asked for; of an image, also while it is here. */
  lease: ResourceHandle | undefined;
  transfer: Readonly<Transfer> | undefined;
  /** Stops what is done with the content. */
  aborter: AbortController;
  state: "absent" | "asked" | "here" | "failed";
  /** On the GPU: an estimate until it has been there. */
  storedBytes: number;
}

interface Patch {
  readonly place: number;
  /** The newest that the listener knows. */
  stage: Stage | undefined;
  readonly builder: StageBuilder;
  /** In the order of their use. */
  readonly needs: readonly Need[];
  /** As last asked for. */
  claims: readonly PatchBudgetRequest[];
}

/** To be granted together. */
interface PatchBudgetRequest extends BudgetRequest {
  readonly needs: readonly Need[];
}

/** Asks for nothing before `demand`. Never calls the listener before it returns. */
export function deliverGeometry(
  geometry: GeometryDescription,
  pool: ResourcePool,
  listener: DeliveryListener,
): Delivery {
  return new GeometryDelivery(geometry, pool, listener);
}

class GeometryDelivery implements Delivery {
  readonly #pool: ResourcePool;
  readonly #listener: DeliveryListener;
  readonly #patches: readonly Patch[];
  readonly #needs: readonly Need[];
  readonly #reported = new Set<string>();
  /** Undefined when transfers have come or gone: there may be thousands of deliveries to ask. */
  #transfers: readonly Readonly<Transfer>[] | undefined;
  #storedBytes: number | undefined;
  #isCancelled = false;

  constructor(geometry: GeometryDescription, pool: ResourcePool, listener: DeliveryListener) {
    this.#pool = pool;
    this.#listener = listener;
    this.#patches = geometry.patches.map((patch, place) => ({
      place,
      builder: deliveryOf(geometry).stageBuilder(geometry, patch, place, pool),
      needs: needsOf(geometry, patch, pool.maxTextureSize),
      claims: [],
      stage: undefined,
    }));
    this.#needs = this.#patches.flatMap(({ needs }) => needs);
  }

  get transfers(): readonly Readonly<Transfer>[] {
    this.#transfers ??= Array.from(new Set(this.#needs.flatMap(({ transfer }) => (transfer ? [transfer] : []))));
    return this.#transfers;
  }

  get isSettled(): boolean {
    return this.#needs.every(({ state }) => state !== "asked");
  }

  get isExhausted(): boolean {
    return this.#needs.every(({ state }) => state === "here" || state === "failed");
  }

  get storedBytes(): number {
    this.#storedBytes ??= this.#needs.reduce(
      (sum, { storedBytes, state }) => sum + (state === "failed" ? 0 : storedBytes),
      0,
    );
    return this.#storedBytes;
  }

  budgetRequests(priorityOf: FilePriority): readonly (readonly BudgetRequest[])[] {
    for (const patch of this.#patches) patch.claims = claimsOf(patch, priorityOf);
    return this.#patches.map(({ claims }) => claims);
  }

  request(priorityOf: FilePriority, granted?: ReadonlySet<BudgetRequest>): void {
    for (const patch of this.#patches) {
      const denied =
        granted && new Set(patch.claims.filter((claim) => !granted.has(claim)).flatMap(({ needs }) => needs));
      for (const need of patch.needs) {
        if (need.state === "here" || need.state === "failed") continue;
        const priority = denied?.has(need) === true ? undefined : priorityOf(patch.place, need.part);
        if (priority === undefined) this.#giveUp(need);
        else if (need.lease !== undefined) need.lease.setPriority(priority);
        else this.#ask(patch, need, priority);
      }
      if (denied !== undefined)
        this.#evict(
          patch,
          patch.needs.filter((need) => need.state === "here" && denied.has(need)),
        );
    }
  }

  cancel(): void {
    this.#isCancelled = true;
    for (const need of this.#needs) this.#release(need);
    for (const { builder } of this.#patches) {
      builder.clear();
      builder.sweep();
    }
  }

  #ask(patch: Patch, need: Need, priority: number): void {
    const { reference, target, expectedBytes } = need.part;
    const lease = this.#pool.acquire({ ...target, url: reference.url, priority, expectedBytes });
    need.lease = lease;
    need.transfer = lease.transfer;
    need.aborter = new AbortController();
    need.state = "asked";
    this.#transfers = undefined;
    void this.#await(patch, need, lease);
  }

  #giveUp(need: Need): void {
    if (need.lease === undefined) return;
    this.#release(need);
    need.state = "absent";
    need.transfer = undefined;
    this.#transfers = undefined;
  }

  #release(need: Need): void {
    need.aborter.abort();
    need.lease?.release();
    need.lease = undefined;
  }

  /** Gives up what is here: the listener first lets go of it. */
  #evict(patch: Patch, evicted: readonly Need[]): void {
    const { builder, needs } = patch;
    if (evicted.length === 0) return;
    if (!builder.isDivisible || evicted.length === needs.filter(({ state }) => state === "here").length)
      builder.clear();
    else for (const { part } of evicted) builder.drop(part);
    this.#show(patch);
    for (const need of evicted) {
      this.#release(need);
      need.state = "absent";
    }
    builder.sweep();
  }

  async #await(patch: Patch, need: Need, lease: ResourceHandle): Promise<void> {
    const { signal } = need.aborter;
    // Given up in between, or given up and asked for again.
    const isOver = () => this.#isCancelled || need.lease !== lease;
    const { builder } = patch;
    try {
      const content = await lease.content;
      if (isOver()) return;
      await builder.accept(need.part, content, signal);
      if (isOver()) return;
      need.state = "here";
      this.#note(patch, need, content);
      this.#show(patch);
      builder.sweep();
    } catch (error) {
      if (isOver()) return;
      need.state = "failed";
      lease.fail(error);
      this.#storedBytes = undefined;
      this.#report(need.part.reference.url, error);
    } finally {
      lease.finish();
    }
    if (this.isSettled) this.#listener.onSettled();
  }

  /** A base that comes after its patch changes nothing. */
  #show(patch: Patch): void {
    const stage = patch.builder.stage();
    if (stage === patch.stage) return;
    patch.stage = stage;
    this.#listener.onStage(patch.place, stage);
  }

  /** What it takes on the GPU is known now, and stays known when it has gone. */
  #note({ builder, needs }: Patch, need: Need, content: Content): void {
    this.#storedBytes = undefined;
    if (content.kind === "image") {
      need.storedBytes = content.image.width * content.image.height * bytesPerTexel;
    } else if (builder.isDivisible && needs.every(isSeparate)) {
      const others = needs.filter((other) => other !== need && other.state === "here");
      need.storedBytes = builder.storedBytes - others.reduce((sum, { storedBytes }) => sum + storedBytes, 0);
    } else if (needs.every(({ state }) => state !== "absent" && state !== "asked")) {
      // Arrays of a patch are one claim: it does not matter which of its files they are counted for.
      needs.forEach((each, place) => {
        each.storedBytes = place === 0 ? builder.storedBytes : 0;
      });
    }
  }

  #report(url: string, error: unknown): void {
    if (this.#reported.has(url)) return;
    this.#reported.add(url);
    this.#listener.onError(asDeliveryError(error, url));
  }
}

function needsOf(geometry: GeometryDescription, patch: PatchDescription, maxTextureSize: number): Need[] {
  return deliveryOf(geometry)
    .patchFilesOf(geometry, patch, maxTextureSize)
    .sort((a, b) => useOf(a) - useOf(b))
    .map((part): Need => ({
      part,
      lease: undefined,
      transfer: undefined,
      aborter: new AbortController(),
      state: "absent",
      storedBytes: part.storedBytes,
    }));
}

/** What each is of no use without comes before it. */
function useOf({ role, plane }: PatchFile): number {
  return plane > 0
    ? 6 + plane
    : ["base", "patch", "coord", "index", "normal", "texCoord", "color", "value"].indexOf(role);
}

function claimsOf({ place, builder, needs }: Patch, priorityOf: FilePriority): PatchBudgetRequest[] {
  const wanted = needs.flatMap((need) => {
    if (need.state === "failed") return [];
    const priority = priorityOf(place, need.part);
    if (priority === undefined && need.state === "absent") return [];
    return [{ need, priority: priority ?? 0 }];
  });
  if (wanted.length === 0) return [];
  if (builder.isDivisible && wanted.every(({ need }) => isSeparate(need))) {
    return wanted.map(({ need, priority }) => ({
      needs: [need],
      key: isImage(need) ? need.part.reference.url : need,
      bytes: need.storedBytes,
      priority,
      isHeld: need.state !== "absent",
    }));
  }
  return [
    {
      needs: wanted.map(({ need }) => need),
      key: builder,
      bytes: wanted.reduce((sum, { need }) => sum + need.storedBytes, 0),
      priority: Math.max(...wanted.map(({ priority }) => priority)),
      isHeld: wanted.some(({ need }) => need.state !== "absent"),
    },
  ];
}

function isImage({
  part: {
    target: { kind },
  },
}: Need): boolean {
  return kind === "texture" || kind === "either";
}

/** Of use, and room on the GPU, for itself. */
function isSeparate(need: Need): boolean {
  return isImage(need) || need.part.target.kind === "patches" || need.part.target.kind === "bases";
}
