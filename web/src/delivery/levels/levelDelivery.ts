// Delivers a mesh or a point cloud with levels of detail: its index, its root, and then the groups that the view needs within the GPU
// memory that the mesh may take. Each group is a patch of the geometry, by its number. What is displayed is always a
// legal cut, so that it is closed: groups open and close in one turn with the changes of their parents. A group whose
// file fails leaves its parents as they are.

import type { LevelGroup } from "../../decode/compact/levelGroup.ts";
import { DecodeError } from "../../decode/decodeError.ts";
import type { GeometryDescription, LevelsDescription, PatchDescription } from "../../document/description.ts";
import type { CutMesh, MeshCut } from "../../levels/cut.ts";
import { chipMemory, chooseCut, errorFactorOf, groupMemory, maxErrorFactor, tolerance } from "../../levels/cut.ts";
import { addPageFile, groupUrl, readLevelIndex } from "../../levels/levelFiles.ts";
import type { LevelIndex } from "../../levels/levelIndex.ts";
import { levelViewsOf, sceneFromLatticesOf } from "../../levels/levelViews.ts";
import { expectedBytesPerVertex, maxMeshBytes } from "../../levels/meshMemory.ts";
import type { ErrorInPixels } from "../../levels/projectedError.ts";
import { errorAround, errorInPixels } from "../../levels/projectedError.ts";
import { requestChanges, ResidentGroups } from "../../levels/transition.ts";
import type { BudgetRequest } from "../../scheduler/budget.ts";
import { asDeliveryError } from "../deliveryError.ts";
import type { GeometryView, LevelStatistics } from "../geometryView.ts";
import type { Delivery, DeliveryListener, FilePriority } from "../geometryDelivery.ts";
import type { PatchFile } from "../patchFiles.ts";
import type { Transfer } from "../progress.ts";
import type { ResourcePool } from "../resourcePool.ts";
import { CameraMotion } from "./cameraMotion.ts";
import { isAborted, LevelRequests } from "./levelRequests.ts";
import type { SharedCut, SharedMesh, SharedMeshCut } from "./sharedCut.ts";
import { sharedCutOf } from "./sharedCut.ts";
import { checkGroup, groupPatch, StoredGroup } from "./storedGroup.ts";

/** An open group that the view does not need is closed after this time in milliseconds. */
const closingDelay = 1000;
/** Files that wait, arrive or are decoded at a time: the scheduler's slots over HTTP/2. 20 were no faster. */
const maxPending = 16;
/** Where a moving camera will be in this time, in milliseconds, groups are requested before it is there. */
const timeAhead = 500;
/** The part of its memory that a mesh takes for them, and their part of the priority of others. */
const shareAhead = 1 / 4;
/** The bytes of a root and of a first page, before the index states them. */
const expectedRootBytes = 20_000;
const expectedPageBytes = 4_000;
const expectedChipBytes = 100_000;

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

interface Levels {
  readonly index: LevelIndex;
  readonly resident: ResidentGroups;
}

class LevelDelivery implements Delivery, SharedMesh {
  readonly followsView = true;
  /** Another view may need other groups. */
  readonly isExhausted = false;
  readonly #geometry: GeometryDescription;
  /** The geometry with a patch for each group that has been displayed. */
  readonly #drawn: GeometryDescription;
  readonly #patches: PatchDescription[];
  /** The whole mesh as a patch. */
  readonly #whole: PatchDescription;
  readonly #pool: Pick<ResourcePool, "acquire" | "storeBytes">;
  readonly #listener: DeliveryListener;
  readonly #requests: LevelRequests;
  readonly #file: PatchFile;
  /** Stays pending where the index cannot be had: then the requests of groups that wait for it are withdrawn. */
  readonly #index = Promise.withResolvers<LevelIndex>();
  /** The groups of `resident` on the GPU. */
  readonly #stored = new Map<number, StoredGroup>();
  /** Groups and pages whose files have failed. */
  readonly #absentGroups = new Set<number>();
  readonly #absentPages = new Set<number>();
  #levels: Levels | undefined;
  #view: GeometryView | undefined;
  /** With the other meshes of the scene. */
  #shared: SharedCut | undefined;
  /** GPU memory that this mesh may take now. */
  #maxBytes = maxMeshBytes;
  /** GPU memory of groups that are being uploaded. */
  #uploadingBytes = 0;
  /** Undefined: nothing is to be requested. */
  #priority: number | undefined;
  #target: MeshCut["target"] = noGroups;
  readonly #motion = new CameraMotion();
  /** Groups that the view will need if the camera goes on as it moves; they are requested and not opened. */
  #ahead: ReadonlySet<number> = noGroups;
  #isSettled = false;
  /** Whether a view has had all that it needs. */
  #isWhole = false;
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
    this.#patches = [whole];
    this.#drawn = { ...geometry, patches: this.#patches };
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
    return this.#levels?.resident.bytes ?? 0;
  }

  levelStatistics(): LevelStatistics {
    if (this.#levels === undefined) return { groups: 0, openGroups: 0, bytes: 0, errorInPixels: 0 };
    const { index, resident } = this.#levels;
    const measure = this.#measure(index);
    const largest = Math.max(
      0,
      ...Array.from(resident.open, (group) => drawnErrorOf(group, index, resident.open, measure)),
    );
    return {
      groups: Array.from(resident.groups).length,
      openGroups: resident.open.size,
      bytes: resident.bytes,
      errorInPixels: largest,
    };
  }

  /** None: `followView` tells how much memory there is. */
  budgetRequests(): readonly (readonly BudgetRequest[])[] {
    return noBudget;
  }

  followView(view: GeometryView, maxBytes: number, scene: object): void {
    this.#view = { ...view, instances: Array.from(view.instances) };
    const shared = sharedCutOf(scene, tolerance);
    if (shared !== this.#shared) this.#shared?.remove(this);
    this.#shared = shared;
    this.#shared.follow(this, Math.min(maxBytes, maxMeshBytes));
    this.#motion.follow(view.views, performance.now());
  }

  request(priorityOf: FilePriority): void {
    this.#priority = priorityOf(0, this.#file);
    this.#update();
  }

  cutMesh(): CutMesh | undefined {
    if (this.#levels === undefined) return undefined;
    const { index, resident } = this.#levels;
    return {
      index,
      errorInPixels: this.#measureAroundFocus(index),
      open: resident.open,
      absent: this.#absentGroups,
      bytesPerVertex: this.#bytesPerVertex(index),
    };
  }

  followSharedCut(): void {
    this.#update();
  }

  cancel(): void {
    this.#isCancelled = true;
    this.#shared?.remove(this);
    clearTimeout(this.#timer);
    this.#requests.withdrawAll();
    for (const stored of this.#stored.values()) stored.close();
    this.#stored.clear();
    this.#requests.forgetAll();
  }

  /** Requests what the view needs, displays what has arrived, and tells when nothing is missing. */
  #update(): void {
    if (this.#isCancelled) return;
    if (this.#priority === undefined) this.#requests.withdrawAll();
    else if (this.#levels === undefined) this.#requestFirst(this.#priority);
    else this.#follow(this.#levels, this.#priority);
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
        this.#levels = { index, resident: new ResidentGroups(index) };
        this.#index.resolve(index);
      });
    if (!groups.has(0) && !this.#absentGroups.has(0))
      this.#requestGroup(0, maxErrorFactor * priority, expectedRootBytes);
  }

  #follow({ index, resident }: Levels, priority: number): void {
    const measure = this.#measureAroundFocus(index);
    const cut = this.#shared?.cutOf(this);
    this.#target = cut?.target ?? noGroups;
    if (cut) this.#maxBytes = cut.maxBytes;
    const isMissing = (group: number) => !resident.has(group) && !this.#absentGroups.has(group);
    const isComplete = (cut?.missingPages.size ?? 0) === 0 && !Array.from(this.#target).some(isMissing);
    this.#ahead = cut && isComplete ? this.#chooseAhead(cut) : noGroups;
    for (const page of cut?.missingPages ?? [])
      if (!this.#requests.pages.has(page) && !this.#absentPages.has(page))
        this.#requestPage(index, page, maxErrorFactor * priority);
    this.#requestGroups(index, resident, (group) =>
      this.#target.has(group) ? priority * errorFactorOf(measure(group)) : priority * shareAhead,
    );
    this.#makeRoom(index, resident);
    this.#move(index, resident);
    this.#settle(this.#requests.pages.size === 0 && !Array.from(this.#target).some(isMissing));
  }

  /** What the cut of the camera ahead has beyond the target, by its errors, as far as memory is left for it. */
  #chooseAhead({ bytes: targetBytes }: SharedMeshCut): ReadonlySet<number> {
    const views = this.#motion.viewsAhead(timeAhead);
    const mesh = this.cutMesh();
    if (views.length === 0 || !this.#view || !mesh) return noGroups;
    const measure = errorInPixels(mesh.index, levelViewsOf(this.#geometry, { ...this.#view, views }));
    const [cut] = chooseCut([{ ...mesh, errorInPixels: measure }], { tolerance, budget: this.#maxBytes }).meshes;
    const ahead = new Set<number>();
    let left = Math.min(shareAhead * this.#maxBytes, this.#maxBytes - targetBytes);
    for (const group of cut?.target ?? []) {
      if (this.#target.has(group)) continue;
      left -= groupMemory(mesh, group);
      if (left < 0) break;
      ahead.add(group);
    }
    return ahead;
  }

  /** The groups that stay on the GPU: a legal set. */
  get #needed(): ReadonlySet<number> {
    return this.#ahead.size > 0 ? new Set([...this.#target, ...this.#ahead]) : this.#target;
  }

  #measure(index: LevelIndex): ErrorInPixels {
    return errorInPixels(index, this.#view ? levelViewsOf(this.#geometry, this.#view) : []);
  }

  #measureAroundFocus(index: LevelIndex): ErrorInPixels {
    const measure = this.#measure(index);
    if (!this.#view?.focus) return measure;
    const { focus, instances } = this.#view;
    return errorAround(measure, index, sceneFromLatticesOf(this.#geometry, instances), focus);
  }

  #requestPage(index: LevelIndex, page: number, priority: number): void {
    this.#requests.requestPage(page, priority, index.pageBytes[page] ?? expectedPageBytes, async (bytes) => {
      await addPageFile(index, page, bytes);
    });
  }

  #requestGroups(index: LevelIndex, resident: ResidentGroups, priorityOf: (group: number) => number): void {
    const { groups } = this.#requests;
    const pending = new Set(groups.keys());
    const available = new Set(Array.from(this.#needed).filter((group) => !this.#absentGroups.has(group)));
    const { request, withdraw } = requestChanges(index, available, resident, pending, maxPending);
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
    const index = await this.#index.promise; // the root may arrive before the index
    if (signal.aborted || this.#levels === undefined) return;
    checkGroup(decoded, index, group, this.#geometry);
    const { resident } = this.#levels;
    const memory = groupMemory({ index, bytesPerVertex: this.#bytesPerVertex(index) }, group);
    this.#uploadingBytes += memory;
    try {
      this.#makeRoom(index, resident);
      const chips = this.#hasChips
        ? await this.#requests.requestChips(group, priority, index.chipBytes(group))
        : undefined;
      if (isAborted(signal)) return;
      const stored = await StoredGroup.store(decoded, this.#geometry, this.#pool.storeBytes, signal, chips);
      if (isAborted(signal)) {
        stored.close();
        return;
      }
      this.#patches[group] = groupPatch(this.#geometry, this.#whole, index, group);
      this.#stored.set(group, stored);
      resident.add(group, stored.byteLength + chipMemory(index, group));
    } finally {
      this.#uploadingBytes -= memory;
    }
  }

  /** Frees what the view does not need as far as the mesh takes more memory than it may. */
  #makeRoom(index: LevelIndex, resident: ResidentGroups): void {
    const surplus = resident.bytes + this.#uploadingBytes - this.#maxBytes;
    if (surplus > 0) this.#apply(index, resident, resident.makeRoom(surplus, this.#needed));
  }

  /** Opens and closes groups, now and when those that are no longer needed have been open for long enough. */
  #move(index: LevelIndex, resident: ResidentGroups): void {
    this.#apply(index, resident, resident.approach(this.#target, performance.now(), closingDelay));
    clearTimeout(this.#timer);
    for (const group of resident.open) {
      if (this.#target.has(group)) continue;
      this.#timer = setTimeout(() => {
        this.#shared?.invalidate();
        this.#update();
      }, closingDelay);
      break;
    }
  }

  /** Displays what the steps change. Groups leave the GPU after the stages that drew them. */
  #apply(index: LevelIndex, resident: ResidentGroups, steps: ReturnType<ResidentGroups["approach"]>): void {
    const changed = new Set<number>();
    const freed: number[] = [];
    for (const { kind, group } of steps) {
      if (kind === "free") {
        freed.push(group);
        continue;
      }
      changed.add(group);
      for (const parent of index.parents(group)) changed.add(parent);
    }
    for (const group of changed) this.#display(index, resident, group);
    for (const group of freed) {
      this.#stored.get(group)?.close();
      this.#stored.delete(group);
      this.#requests.forget(group);
    }
  }

  #display(index: LevelIndex, resident: ResidentGroups, group: number): void {
    const stored = resident.open.has(group) ? this.#stored.get(group) : undefined;
    const name = group > 0 || this.#isWhole ? "full" : "base";
    const children = Array.from(index.children(group));
    const bounds = { x: 0, y: 0, z: 0, radius: 0, reach: 0, error: 0 };
    const errorOf = (child: number): number => {
      index.readBounds(withKnownError(index, child, group), bounds);
      return bounds.error;
    };
    this.#listener.onStage(group, stored?.stage(name, children, resident.open, errorOf, errorOf(group)), this.#drawn);
  }

  #settle(isSettled: boolean): void {
    const wasSettled = this.#isSettled;
    this.#isSettled = isSettled;
    if (wasSettled || !isSettled) return;
    if (!this.#isWhole && this.#levels && this.#absentGroups.size === 0) {
      this.#isWhole = true;
      this.#display(this.#levels.index, this.#levels.resident, 0);
    }
    this.#listener.onSettled();
  }

  /** That of any group: all have the same attributes. */
  #bytesPerVertex(index: LevelIndex): number {
    for (const [group, { byteLength }] of this.#stored) {
      const indexBytes = 3 * index.triangles(group) * (index.vertices(group) > 65536 ? 4 : 2);
      return (byteLength - indexBytes) / index.vertices(group);
    }
    return expectedBytesPerVertex;
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

/** The child, or its parent, whose error is at least as large, where the child is on a page that is not here. */
function withKnownError(index: LevelIndex, child: number, parent: number): number {
  return index.has(child) ? child : parent;
}

/** The largest error of the coarse forms that an open group draws: those of its closed children. */
function drawnErrorOf(group: number, index: LevelIndex, open: ReadonlySet<number>, measure: ErrorInPixels): number {
  const closed = Array.from(index.children(group)).filter((child) => !open.has(child));
  const errors = closed.map((child) => measure(withKnownError(index, child, group)));
  return Math.max(0, ...errors);
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
