// Delivers the stages of one geometry: requests the files of its patches in the order that the scene sets, turns them
// into stages, and reports files that fail. A patch whose file fails has the stages that its other files allow. Files
// that the GPU budget has no room for are evicted, and can be requested again.

import type { Stage } from "../stage/stage.ts";
import type { GeometryDescription, PatchDescription, Playback } from "../document/description.ts";
import type { BudgetRequest } from "../scheduler/budget.ts";
import type { DeliveryError } from "./deliveryError.ts";
import { asDeliveryError } from "./deliveryError.ts";
import type { GeometryView, LevelStatistics } from "./geometryView.ts";
import type { PatchFile } from "./patchFiles.ts";
import { bytesPerTexel, fileRoles, isForTextures } from "./patchFiles.ts";
import type { Transfer } from "./progress.ts";
import type { Content } from "./content.ts";
import type { ResourceHandle, ResourcePool } from "./resourcePool.ts";
import { deliveryOf } from "./encodings/encodings.ts";
import type { StageBuilder } from "./stageBuilder.ts";

export interface DeliveryListener {
  /**
   * A new stage of a patch, which replaces the previous one as a whole. Undefined: nothing of the patch is left.
   * `drawn`: the geometry with what the document does not state (live streams); absent: the geometry itself.
   */
  onStage(patchIndex: number, stage: Stage | undefined, drawn?: GeometryDescription): void;
  /** The stages end; others replace them before the page's next frame, for which their memory may be used. */
  onSwap?(): void;
  /** The vertices of a live stream have changed; the stage stays the same. */
  onFrame?(frame: LiveFrame): void;
  /** Called once for each URL that fails. */
  onError(error: DeliveryError): void;
  /**
   * Every requested file has loaded or failed. Called again after each later `request` that requires more files.
   */
  onSettled(): void;
}

/** A frame of a live stream, as the stream's publisher numbers it. */
export interface LiveFrame {
  readonly number: number;
  /** The number of the first frame with the same vertices and lattice. */
  readonly epoch: number;
  /** Seconds of the publisher's clock. */
  readonly time: number;
}

/** The priority of a file; undefined: it is not needed now. */
export type FilePriority = (patchIndex: number, file: PatchFile) => number | undefined;

export interface Delivery {
  /** The transfers of the requested files. */
  readonly transfers: readonly Readonly<Transfer>[];
  /** Whether every requested file has loaded or failed. */
  readonly isSettled: boolean;
  /** Whether every file of the geometry has loaded or failed. */
  readonly isExhausted: boolean;
  /** Whether the view decides about files that have not been loaded: where shapes are, and from where they are seen. */
  readonly followsView: boolean;
  /** Bytes of all files on the GPU; an estimate for those that have not been decoded. */
  readonly storedBytes: number;
  /** The GPU memory that files require or hold: a list for each patch, in the order in which files become useful. */
  budgetRequests(priorityOf: FilePriority): readonly (readonly BudgetRequest[])[];
  /**
   * Requests the files that have a priority, updates the priorities of those that are being loaded, and aborts those
   * without. Ready files stay; but if `granted` is given, files of a budget request that is not in it are evicted.
   */
  request(priorityOf: FilePriority, granted?: ReadonlySet<BudgetRequest>): void;
  /**
   * Levels of detail only: how the geometry is seen, and the GPU memory that it may take together with all others of
   * the same `scene`.
   */
  followView?(view: GeometryView, maxBytes: number, scene: object): void;
  /** Levels of detail only. */
  levelStatistics?(): LevelStatistics;
  /** Live streams only. */
  setPlayback?(playback: Playback): void;
  /** Aborts and frees everything. The listener is not called again; its stages must no longer be drawn. */
  cancel(): void;
}

/** A file that a patch needs, and its state. */
interface TrackedFile {
  readonly file: PatchFile;
  /** Defined while the file is requested; of an image, also while it is ready. */
  handle: ResourceHandle | undefined;
  transfer: Readonly<Transfer> | undefined;
  /** Stops decoding and uploading the content. */
  aborter: AbortController;
  state: "absent" | "requested" | "ready" | "failed";
  /** Bytes on the GPU: an estimate until the file has been decoded once. */
  storedBytes: number;
}

interface PatchState {
  readonly index: number;
  /** The stage that the listener received last. */
  stage: Stage | undefined;
  readonly builder: StageBuilder;
  /** In the order in which they become useful. */
  readonly files: readonly TrackedFile[];
  /** The requests of the last call to `budgetRequests`. */
  budgetRequests: readonly PatchBudgetRequest[];
}

/** Files of a patch that are granted or denied together. */
interface PatchBudgetRequest extends BudgetRequest {
  readonly files: readonly TrackedFile[];
}

/** Where a delivery gets its files from. */
export type FilePool = Pick<ResourcePool, "acquire" | "runJob" | "storeBytes" | "maxTextureSize">;

/** Requests nothing before `request` is called. Never calls the listener before it returns. */
export function deliverGeometry(geometry: GeometryDescription, pool: FilePool, listener: DeliveryListener): Delivery {
  return new GeometryDelivery(geometry, pool, listener);
}

class GeometryDelivery implements Delivery {
  readonly #pool: FilePool;
  readonly #listener: DeliveryListener;
  readonly #patches: readonly PatchState[];
  readonly #files: readonly TrackedFile[];
  readonly #reportedUrls = new Set<string>();
  /** A cache, undefined when transfers were added or removed: a scene may have thousands of deliveries. */
  #transfers: readonly Readonly<Transfer>[] | undefined;
  #storedBytes: number | undefined;
  #isCancelled = false;

  constructor(geometry: GeometryDescription, pool: FilePool, listener: DeliveryListener) {
    this.#pool = pool;
    this.#listener = listener;
    this.#patches = geometry.patches.map((patch, index) => ({
      index,
      builder: deliveryOf(geometry).stageBuilder(geometry, patch, index, pool),
      files: trackedFilesOf(geometry, patch, pool.maxTextureSize),
      budgetRequests: [],
      stage: undefined,
    }));
    this.#files = this.#patches.flatMap(({ files }) => files);
  }

  get transfers(): readonly Readonly<Transfer>[] {
    this.#transfers ??= Array.from(new Set(this.#files.flatMap(({ transfer }) => (transfer ? [transfer] : []))));
    return this.#transfers;
  }

  get isSettled(): boolean {
    return this.#files.every(({ state }) => state !== "requested");
  }

  get isExhausted(): boolean {
    return this.#files.every(({ state }) => state === "ready" || state === "failed");
  }

  get followsView(): boolean {
    return this.#files.some(
      ({ state, handle, file }) =>
        state !== "ready" && state !== "failed" && (handle !== undefined || !isForTextures(file)),
    );
  }

  get storedBytes(): number {
    this.#storedBytes ??= this.#files.reduce(
      (sum, { storedBytes, state }) => sum + (state === "failed" ? 0 : storedBytes),
      0,
    );
    return this.#storedBytes;
  }

  budgetRequests(priorityOf: FilePriority): readonly (readonly BudgetRequest[])[] {
    for (const patch of this.#patches) patch.budgetRequests = budgetRequestsOf(patch, priorityOf);
    return this.#patches.map(({ budgetRequests }) => budgetRequests);
  }

  request(priorityOf: FilePriority, granted?: ReadonlySet<BudgetRequest>): void {
    for (const patch of this.#patches) {
      const denied =
        granted &&
        new Set(patch.budgetRequests.filter((request) => !granted.has(request)).flatMap(({ files }) => files));
      for (const tracked of patch.files) {
        if (tracked.state === "ready" || tracked.state === "failed") continue;
        const priority = denied?.has(tracked) === true ? undefined : priorityOf(patch.index, tracked.file);
        if (priority === undefined) this.#withdraw(tracked);
        else if (tracked.handle !== undefined) tracked.handle.setPriority(priority);
        else this.#startRequest(patch, tracked, priority);
      }
      if (denied !== undefined)
        this.#evict(
          patch,
          patch.files.filter((tracked) => tracked.state === "ready" && denied.has(tracked)),
        );
    }
  }

  cancel(): void {
    this.#isCancelled = true;
    for (const tracked of this.#files) this.#release(tracked);
    for (const { builder } of this.#patches) {
      builder.clear();
      builder.sweep();
    }
  }

  #startRequest(patch: PatchState, tracked: TrackedFile, priority: number): void {
    const { reference, target, expectedBytes } = tracked.file;
    const { url, furtherUrls } = reference;
    const handle = this.#pool.acquire({ ...target, url, furtherUrls, priority, expectedBytes });
    tracked.handle = handle;
    tracked.transfer = handle.transfer;
    tracked.aborter = new AbortController();
    tracked.state = "requested";
    this.#transfers = undefined;
    void this.#receive(patch, tracked, handle);
  }

  #withdraw(tracked: TrackedFile): void {
    if (tracked.handle === undefined) return;
    this.#release(tracked);
    tracked.state = "absent";
    tracked.transfer = undefined;
    this.#transfers = undefined;
  }

  #release(tracked: TrackedFile): void {
    tracked.aborter.abort();
    tracked.handle?.release();
    tracked.handle = undefined;
  }

  /** The listener gets the stage without these files before their memory is freed. */
  #evict(patch: PatchState, evicted: readonly TrackedFile[]): void {
    const { builder, files } = patch;
    if (evicted.length === 0) return;
    if (!builder.isDivisible || evicted.length === files.filter(({ state }) => state === "ready").length)
      builder.clear();
    else for (const { file } of evicted) builder.drop(file);
    this.#updateStage(patch);
    for (const tracked of evicted) {
      this.#release(tracked);
      tracked.state = "absent";
    }
    builder.sweep();
  }

  async #receive(patch: PatchState, tracked: TrackedFile, handle: ResourceHandle): Promise<void> {
    const { signal } = tracked.aborter;
    // The file may have been withdrawn since, and requested again.
    const isReplaced = () => this.#isCancelled || tracked.handle !== handle;
    const { builder } = patch;
    try {
      const content = await handle.content;
      if (isReplaced()) return;
      await builder.accept(tracked.file, content, signal);
      if (isReplaced()) return;
      tracked.state = "ready";
      this.#recordStoredBytes(patch, tracked, content);
      this.#updateStage(patch);
      builder.sweep();
    } catch (error) {
      if (isReplaced()) return;
      tracked.state = "failed";
      handle.fail(error);
      this.#storedBytes = undefined;
      this.#report(tracked.file.reference.url, error);
    } finally {
      handle.finish();
    }
    if (this.isSettled) this.#listener.onSettled();
  }

  /** A base mesh that arrives after its patch does not change the stage. */
  #updateStage(patch: PatchState): void {
    const stage = patch.builder.stage();
    if (stage === patch.stage) return;
    patch.stage = stage;
    this.#listener.onStage(patch.index, stage);
  }

  /** The file's bytes on the GPU are known now, and stay known after an eviction. */
  #recordStoredBytes({ builder, files }: PatchState, tracked: TrackedFile, content: Content): void {
    this.#storedBytes = undefined;
    if (content.kind === "live") {
      tracked.storedBytes = content.vertices.byteLength;
    } else if (content.kind === "image") {
      tracked.storedBytes = content.image.width * content.image.height * bytesPerTexel;
    } else if (builder.isDivisible && files.every(isSeparate)) {
      const others = files.filter((other) => other !== tracked && other.state === "ready");
      tracked.storedBytes = builder.storedBytes - others.reduce((sum, { storedBytes }) => sum + storedBytes, 0);
    } else if (files.every(({ state }) => state !== "absent" && state !== "requested")) {
      // The arrays of a patch are one budget request: it does not matter which of its files they are counted for.
      files.forEach((each, index) => {
        each.storedBytes = index === 0 ? builder.storedBytes : 0;
      });
    }
  }

  #report(url: string, error: unknown): void {
    if (this.#reportedUrls.has(url)) return;
    this.#reportedUrls.add(url);
    this.#listener.onError(asDeliveryError(error, url));
  }
}

function trackedFilesOf(geometry: GeometryDescription, patch: PatchDescription, maxTextureSize: number): TrackedFile[] {
  return deliveryOf(geometry)
    .patchFilesOf(geometry, patch, maxTextureSize)
    .sort((a, b) => usageRank(a) - usageRank(b))
    .map((file): TrackedFile => ({
      file,
      handle: undefined,
      transfer: undefined,
      aborter: new AbortController(),
      state: "absent",
      storedBytes: file.storedBytes,
    }));
}

/** A file is useful only together with those of smaller ranks. */
function usageRank({ role, plane }: PatchFile): number {
  return plane > 0 ? fileRoles.indexOf("value") + plane - 1 : fileRoles.indexOf(role);
}

function budgetRequestsOf({ index, builder, files }: PatchState, priorityOf: FilePriority): PatchBudgetRequest[] {
  const requested = files.flatMap((tracked) => {
    if (tracked.state === "failed") return [];
    const priority = priorityOf(index, tracked.file);
    if (priority === undefined && tracked.state === "absent") return [];
    return [{ tracked, priority: priority ?? 0 }];
  });
  if (requested.length === 0) return [];
  if (builder.isDivisible && requested.every(({ tracked }) => isSeparate(tracked))) {
    return requested.map(({ tracked, priority }) => ({
      files: [tracked],
      key: isImage(tracked) ? tracked.file.reference.url : tracked,
      bytes: tracked.storedBytes,
      priority,
      isAllocated: tracked.state !== "absent",
    }));
  }
  return [
    {
      files: requested.map(({ tracked }) => tracked),
      key: builder,
      bytes: requested.reduce((sum, { tracked }) => sum + tracked.storedBytes, 0),
      priority: Math.max(...requested.map(({ priority }) => priority)),
      isAllocated: requested.some(({ tracked }) => tracked.state !== "absent"),
    },
  ];
}

function isImage({
  file: {
    target: { kind },
  },
}: TrackedFile): boolean {
  return kind === "texture" || kind === "either";
}

/** Whether the file is useful, and counts its GPU memory, independently of the patch's other files. */
function isSeparate(tracked: TrackedFile): boolean {
  return isImage(tracked) || ["patches", "bases", "live"].includes(tracked.file.target.kind);
}
