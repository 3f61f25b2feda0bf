// Delivers a mesh or a point cloud with levels of detail: its index, its root, and then the groups that the view needs
// within the GPU memory that the mesh may take. A group whose file fails leaves its parents as they are.

import type { LevelGroup } from "../../decode/compact/levelGroup.ts";
import { DecodeError } from "../../decode/decodeError.ts";
import type { GeometryDescription, LevelsDescription, PatchDescription } from "../../document/description.ts";
import type { CutMesh } from "../../levels/cut.ts";
import { errorFactorOf, groupMemory, maxErrorFactor, tolerance } from "../../levels/cut.ts";
import { addPageFile, groupUrl, readLevelIndex } from "../../levels/levelFiles.ts";
import type { LevelIndex } from "../../levels/levelIndex.ts";
import { maxMeshBytes } from "../../levels/meshMemory.ts";
import { requestChanges } from "../../levels/transition.ts";
import type { BudgetRequest } from "../../scheduler/budget.ts";
import { asDeliveryError } from "../deliveryError.ts";
import type { GeometryView, LevelStatistics } from "../geometryView.ts";
import type { Delivery, DeliveryListener, FilePriority } from "../geometryDelivery.ts";
import type { PatchFile } from "../patchFiles.ts";
import type { Transfer } from "../progress.ts";
import type { ResourcePool } from "../resourcePool.ts";
import { DisplayedGroups } from "./displayedGroups.ts";
import { isAborted, LevelRequests } from "./levelRequests.ts";
import { MeshView, shareAhead } from "./meshView.ts";
import type { SharedCut, SharedMesh } from "./sharedCut.ts";
import { sharedCutOf } from "./sharedCut.ts";
import { checkGroup, StoredGroup } from "./storedGroup.ts";

/** An open group that the view does not need is closed after this time in milliseconds. */
const closingDelay = 1000;
/** Files that wait, arrive or are decoded at a time: the scheduler's slots over HTTP/2. 20 were no faster. */
const maxPending = 16;
/** The bytes of a root, of its image and of a first page, before the index states them. */
const expectedRootBytes = 20_000;
const expectedChipBytes = 100_000;
const expectedPageBytes = 4_000;

const noGroups: ReadonlySet<number> = new Set();
const noBudget: readonly (readonly BudgetRequest[])[] = [];

/** Requests nothing before `request` is called. */
export function deliverLevels(
  geometry: GeometryDescription,
  levels: LevelsDescription,
  pool: Pick<ResourcePool, "acquire" | "storeBytes">,
  listener: DeliveryListener,
): Delivery {
  return new LevelDelivery(geometry, levels, pool, listener);
}

class LevelDelivery implements Delivery, SharedMesh {
  readonly followsView = true;
  /** Another view may need other groups. */
  readonly isExhausted = false;
  readonly #geometry: GeometryDescription;
  /** The whole mesh as a patch. */
  readonly #whole: PatchDescription;
  readonly #pool: Pick<ResourcePool, "acquire" | "storeBytes">;
  readonly #listener: DeliveryListener;
  readonly #requests: LevelRequests;
  readonly #file: PatchFile;
  /** Groups and pages whose files have failed. */
  readonly #absentGroups = new Set<number>();
  readonly #absentPages = new Set<number>();
  /** Stays pending where the index cannot be had: then the requests of groups that wait for it are withdrawn. */
  readonly #indexed = Promise.withResolvers<DisplayedGroups>();
  /** Undefined before the index has arrived. */
  #displayed: DisplayedGroups | undefined;
  readonly #view: MeshView;
  /** With the other meshes of the scene. */
  #shared: SharedCut | undefined;
  /** GPU memory that this mesh may take now. */
  #maxBytes = maxMeshBytes;
  /** GPU memory of groups that are being uploaded. */
  #uploadingBytes = 0;
  /** Undefined: nothing is to be requested. */
  #priority: number | undefined;
  #target = noGroups;
  /** Groups that the view will need if the camera goes on as it moves; they are requested and not opened. */
  #ahead = noGroups;
  #isSettled = false;
  #timer: ReturnType<typeof setTimeout> | undefined;
  #isCancelled = false;

  constructor(
    geometry: GeometryDescription,
    { url }: LevelsDescription,
    pool: Pick<ResourcePool, "acquire" | "storeBytes">,
    listener: DeliveryListener,
  ) {
    const [whole] = geometry.patches;
    if (whole === undefined) throw new RangeError("a geometry with levels has one patch for all");
    this.#geometry = geometry;
    this.#whole = whole;
    this.#view = new MeshView(geometry);
    this.#pool = pool;
    this.#listener = listener;
    this.#file = fileOf(url);
    this.#requests = new LevelRequests(pool, url, {
      onReceived: () => {
        this.#shared?.invalidate();
        this.#update();
      },
      onError: (file, failed, error) => {
        if ("page" in file) this.#absentPages.add(file.page);
        else this.#absentGroups.add(file.group);
        this.#report(failed, error);
      },
    });
  }

  get transfers(): readonly Readonly<Transfer>[] {
    return this.#requests.transfers;
  }

  /** Whether groups have images of their own. */
  get #hasChips(): boolean {
    return this.#geometry.levels?.chips !== undefined;
  }

  get isSettled(): boolean {
    return this.#isSettled;
  }

  get storedBytes(): number {
    return this.#displayed?.bytes ?? 0;
  }

  levelStatistics(): LevelStatistics {
    const displayed = this.#displayed;
    if (displayed === undefined) return { groups: 0, openGroups: 0, bytes: 0, errorInPixels: 0 };
    return displayed.statistics(this.#view.errorsInPixels(displayed.index));
  }

  /** None: `followView` tells how much memory there is. */
  budgetRequests(): readonly (readonly BudgetRequest[])[] {
    return noBudget;
  }

  followView(view: GeometryView, maxBytes: number, scene: object): void {
    const shared = sharedCutOf(scene, tolerance);
    if (shared !== this.#shared) this.#shared?.remove(this);
    this.#shared = shared;
    this.#shared.follow(this, Math.min(maxBytes, maxMeshBytes));
    this.#view.follow(view, performance.now());
  }

  request(priorityOf: FilePriority): void {
    this.#priority = priorityOf(0, this.#file);
    this.#update();
  }

  cutMesh(): CutMesh | undefined {
    if (this.#displayed === undefined) return undefined;
    const { index, open, bytesPerVertex } = this.#displayed;
    const errorInPixels = this.#view.errorsAroundFocus(index);
    return { index, errorInPixels, open, absent: this.#absentGroups, bytesPerVertex };
  }

  followSharedCut(): void {
    this.#update();
  }

  cancel(): void {
    this.#isCancelled = true;
    this.#shared?.remove(this);
    clearTimeout(this.#timer);
    this.#requests.withdrawAll();
    this.#displayed?.close();
    this.#requests.forgetAll();
  }

  /** Requests what the view needs, displays what has arrived, and tells when nothing is missing. */
  #update(): void {
    if (this.#isCancelled) return;
    if (this.#priority === undefined) this.#requests.withdrawAll();
    else if (this.#displayed === undefined) this.#requestFirst(this.#priority);
    else this.#follow(this.#displayed, this.#priority);
  }

  #requestFirst(priority: number): void {
    const { pages, groups } = this.#requests;
    if (this.#absentPages.has(0)) return; // the root cannot be displayed without the index
    if (!pages.has(0))
      this.#requests.requestPage(0, maxErrorFactor * priority, expectedPageBytes, async (bytes) => {
        const index = await readLevelIndex(bytes);
        if (this.#isCancelled) return;
        if (index.hasChips !== this.#hasChips)
          throw new DecodeError("malformed", "states images of groups and the node none, or the reverse");
        this.#displayed = new DisplayedGroups(this.#geometry, this.#whole, index, this.#listener);
        this.#indexed.resolve(this.#displayed);
      });
    if (!groups.has(0) && !this.#absentGroups.has(0))
      this.#requestGroup(0, maxErrorFactor * priority, expectedRootBytes);
  }

  #follow(displayed: DisplayedGroups, priority: number): void {
    const { index, open, bytesPerVertex } = displayed;
    const cut = this.#shared?.cutOf(this);
    this.#target = cut?.target ?? noGroups;
    if (cut) this.#maxBytes = cut.maxBytes;
    const isMissing = (group: number) => !displayed.has(group) && !this.#absentGroups.has(group);
    const isComplete = cut?.missingPages.size === 0 && !Array.from(this.#target).some(isMissing);
    this.#ahead = isComplete
      ? this.#view.groupsAhead({ index, open, absent: this.#absentGroups, bytesPerVertex }, cut)
      : noGroups;
    for (const page of cut?.missingPages ?? [])
      if (!this.#requests.pages.has(page) && !this.#absentPages.has(page))
        this.#requestPage(index, page, maxErrorFactor * priority);
    const errorInPixels = this.#view.errorsAroundFocus(index);
    this.#requestGroups(displayed, (group) =>
      this.#target.has(group) ? priority * errorFactorOf(errorInPixels(group)) : priority * shareAhead,
    );
    this.#makeRoom(displayed);
    this.#move(displayed);
    this.#settle(this.#requests.pages.size === 0 && !Array.from(this.#target).some(isMissing));
  }

  /** The groups that stay on the GPU: a legal set. */
  get #needed(): ReadonlySet<number> {
    return this.#ahead.size > 0 ? new Set([...this.#target, ...this.#ahead]) : this.#target;
  }

  #requestPage(index: LevelIndex, page: number, priority: number): void {
    this.#requests.requestPage(page, priority, index.pageBytes[page] ?? expectedPageBytes, async (bytes) => {
      await addPageFile(index, page, bytes);
    });
  }

  #requestGroups(displayed: DisplayedGroups, priorityOf: (group: number) => number): void {
    const { index } = displayed;
    const { groups } = this.#requests;
    const pending = new Set(groups.keys());
    const available = new Set(Array.from(this.#needed).filter((group) => !this.#absentGroups.has(group)));
    const { request, withdraw } = requestChanges(index, available, displayed, pending, maxPending);
    for (const group of withdraw) this.#requests.withdraw(group);
    for (const group of groups.keys()) this.#requests.setPriority(group, priorityOf(group));
    for (const group of request) this.#requestGroup(group, priorityOf(group), index.bytes(group));
  }

  #requestGroup(group: number, priority: number, bytes: number): void {
    // That of the root is always needed; those of others follow when there is room for them.
    if (group === 0 && this.#hasChips) void this.#requests.requestChips(0, priority, expectedChipBytes);
    this.#requests.requestGroup(group, priority, bytes, (decoded, signal) =>
      this.#admit(group, decoded, priority, signal),
    );
  }

  /** Uploads a group that has arrived, and makes room for it. */
  async #admit(group: number, decoded: LevelGroup, priority: number, signal: AbortSignal): Promise<void> {
    const displayed = await this.#indexed.promise; // the root may arrive before the index
    if (signal.aborted) return;
    const { index, bytesPerVertex } = displayed;
    checkGroup(decoded, index, group, this.#geometry);
    const memory = groupMemory({ index, bytesPerVertex }, group);
    this.#uploadingBytes += memory;
    try {
      this.#makeRoom(displayed);
      const chips = this.#hasChips
        ? await this.#requests.requestChips(group, priority, index.chipBytes(group))
        : undefined;
      if (isAborted(signal)) return;
      const stored = await StoredGroup.store(decoded, this.#geometry, this.#pool.storeBytes, signal, chips);
      if (isAborted(signal)) stored.close();
      else displayed.add(group, stored);
    } finally {
      this.#uploadingBytes -= memory;
    }
  }

  /** Frees what the view does not need as far as the mesh takes more memory than it may. */
  #makeRoom(displayed: DisplayedGroups): void {
    const surplus = displayed.bytes + this.#uploadingBytes - this.#maxBytes;
    if (surplus > 0) for (const group of displayed.makeRoom(surplus, this.#needed)) this.#requests.forget(group);
  }

  /** Opens and closes groups, now and when those that are no longer needed have been open for long enough. */
  #move(displayed: DisplayedGroups): void {
    displayed.approach(this.#target, performance.now(), closingDelay);
    clearTimeout(this.#timer);
    if (Array.from(displayed.open).every((group) => this.#target.has(group))) return;
    this.#timer = setTimeout(() => {
      this.#shared?.invalidate();
      this.#update();
    }, closingDelay);
  }

  #settle(isSettled: boolean): void {
    const wasSettled = this.#isSettled;
    this.#isSettled = isSettled;
    if (wasSettled || !isSettled) return;
    if (this.#absentGroups.size === 0) this.#displayed?.complete();
    this.#listener.onSettled();
  }

  /** A file has failed. Without the index, or without a root, nothing more can be displayed. */
  #report(url: string, error: unknown): void {
    if (this.#isCancelled) return;
    this.#shared?.invalidate();
    this.#listener.onError(asDeliveryError(error, url));
    if (this.#absentPages.has(0)) {
      this.#requests.withdrawAll();
      this.#settle(true);
    } else this.#update();
  }
}

/** Stands for all files of a mesh, whose priority is that of the mesh. */
function fileOf(indexUrl: string): PatchFile {
  return {
    role: "patch",
    plane: 0,
    reference: { url: groupUrl(indexUrl, 0), patchIndex: 0 },
    target: { kind: "group", job: "compactGroup" },
    chunk: { type: "patch", plane: 0 },
    expectedBytes: expectedRootBytes,
    storedBytes: 0,
  };
}
