// The preview of a scene: its base meshes, drawn before the runtime has been loaded.
// Its canvas covers the canvas of the <imgeo-view> until that displays the same shapes, or,
// where the preview displays the whole scene, until something changes. The preview follows
// changes of the document and of the element's size. It ends when its picture would differ
// from the runtime's.

import type { Base } from "../decode/compact/baseBuffers.ts";
import type { PatchBuffers } from "../decode/compact/patchBuffers.ts";
import type { SceneElement } from "../document/element.ts";
import { hasDeformation } from "../document/deformation.ts";
import type { EarlyContent, EarlyFile, EarlyRequest } from "./earlyLoading.ts";
import { EarlyLoading } from "./earlyLoading.ts";
import { patchFilesOf } from "./earlyPatches.ts";
import type { ChooseFirstGroups, FirstGroups } from "./firstGroups.ts";
import type { PrefetchedBases, PrefetchedFile } from "./prefetchedBases.ts";
import type { PreviewContent } from "./previewContent.ts";
import {
  absoluteUrlOf,
  baseUrlsOf,
  hasLevels,
  isDrawnEarly,
  maxSmallBytes,
  patchBytesOf,
  previewContentOf,
  sumOf,
} from "./previewContent.ts";
import { pause } from "../scheduler/pause.ts";
import { slotCountFor } from "../scheduler/downloadSlots.ts";
import { isLineSlow, lineBitsPerSecond } from "../workers/lineRate.ts";
import type { PreviewMesh } from "./previewRenderer.ts";
import { PreviewRenderer, isDrawable, isDrawableGroup, isDrawablePatch, previewCameraOf } from "./previewRenderer.ts";
import type { PreviewScene, PreviewShape } from "./previewScene.ts";
import { contextOf } from "../render/context.ts";
import type { StageName } from "../stage/stage.ts";
import { beforeNextFrame } from "../render/frames/nextFrame.ts";
import { isSceneNode } from "../element/sceneNodes.ts";
import { deviceSizeOf, observeDeviceSize } from "../element/visibility.ts";

/** A shape that a preview displays. */
export interface PreviewedShape {
  readonly element: SceneElement;
  /**
   * Indices of the patches that have triangles: in their segment of the base, or at all. Of a mesh with levels of
   * detail, the numbers of its open groups.
   */
  readonly patches: readonly number[];
  readonly stage: "base" | "full";
}

/** Patches that a preview draws. */
export interface PatchLoading {
  /** Resolves when little of them is still to come. */
  readonly isNear: Promise<unknown>;
  /** Resolves when the preview has drawn them, or will not. */
  readonly isSettled: Promise<unknown>;
}

/**
 * More patches than `maxSmallBytes` are drawn by the preview, too, where they arrive within this time: starting the
 * runtime would delay them for as long.
 */
const maxArrivalMs = 600;

/** Where small patches arrive within this time, no bases are decoded and drawn: both would delay the patches. */
const maxInstantArrivalMs = 30;

/** If such patches have not been decoded after this time, bases are drawn all the same. */
const maxInstantWaitMs = 400;

/** Roots of meshes with levels of detail are decoded after this time, even if it is not known which groups the view needs. */
const maxChoiceMs = 100;

/** Expected bytes of patches that are requested and decoded before the runtime needs them. */
const maxEarlyBytes = 2 * 2 ** 20;

interface RequestedFile extends EarlyFile {
  readonly url: string;
}

/** Bytes that arrive within a time at the rate measured so far. */
function bytesWithin(milliseconds: number): number {
  return ((lineBitsPerSecond() ?? 0) / 8000) * milliseconds;
}

/** Loads the module that chooses groups of meshes with levels of detail. */
export type LoadFirstGroups = () => Promise<{ readonly chooseFirstGroups: ChooseFirstGroups }>;

/** Whether all files of a scene arrive sooner than the runtime would start. */
function arrivesSoon(bytes: number): boolean {
  return bytes <= maxSmallBytes || bytes <= Math.min(bytesWithin(maxArrivalMs), maxEarlyBytes);
}

/** Whether all patches arrive and are decoded about as soon as bases would be drawn. */
function arrivesAtOnce(bytes: number): boolean {
  return bytes <= Math.min(bytesWithin(maxInstantArrivalMs), maxSmallBytes);
}

/** The files of all patches in the order in which the camera needs them; none for a canvas without area. */
function patchRequestsOf(scene: PreviewScene, { width, height }: HTMLCanvasElement): readonly EarlyRequest[] {
  if (width === 0 || height === 0) return [];
  return patchFilesOf(scene, previewCameraOf(scene, width, height), absoluteUrlOf);
}

/** The groups that the view of a scene needs; undefined for a canvas without area, or if they cannot be chosen. */
async function chooseGroups(
  { scene, budget }: PreviewContent,
  { width, height }: HTMLCanvasElement,
  early: EarlyLoading,
  loadFirstGroups: LoadFirstGroups,
): Promise<FirstGroups | undefined> {
  if (width === 0 || height === 0) return undefined;
  try {
    const { chooseFirstGroups } = await loadFirstGroups();
    return await chooseFirstGroups(scene, previewCameraOf(scene, width, height), budget, absoluteUrlOf, early);
  } catch {
    return undefined; // the runtime reports what cannot be loaded
  }
}

/** Fetches a file into the browser's cache. */
function prefetch(url: string): void {
  fetch(url, { priority: "low" })
    .then((response) => response.arrayBuffer())
    .catch(() => undefined); // the workers try themselves
}

export class Preview {
  readonly canvas: HTMLCanvasElement;
  /** Resolves when little of the bases is still to come. */
  readonly isNear: Promise<unknown>;
  /** What it loads for the runtime. */
  readonly early: EarlyLoading;
  /** Resolves when the preview has been drawn, or has ended. */
  readonly settled: Promise<unknown>;
  /** Called when the preview ends. */
  onEnd: () => void = () => undefined;
  readonly #x3d: Element;
  readonly #renderer: PreviewRenderer;
  readonly #bases = new Map<string, readonly Base[]>();
  /** Resolves when it is known which groups of meshes with levels of detail the view needs, or cannot be known. */
  readonly isChosen: Promise<unknown>;
  /** Those groups. */
  #levels: FirstGroups | undefined;
  /** Files of patches that have been decoded, by URL. */
  readonly #patches = new Map<string, readonly PatchBuffers[]>();
  readonly #settle: () => void;
  /** Resolves when the patches that drawPatches() requests have been decoded, or one has failed. */
  readonly #patchDecoding = Promise.withResolvers<undefined>();
  readonly #listeners = new AbortController();
  /** Those that follow changes of the document and of the size. */
  readonly #changeListeners = new AbortController();
  readonly #baseOf = ({ base }: PreviewShape): Base | undefined =>
    base && this.#bases.get(absoluteUrlOf(base.url))?.[base.patchIndex];
  #content: PreviewContent;
  #state: "waiting" | "decoding" | "drawn" | "ended" = "waiting";
  #areBasesDecoded = false;
  /** Whether the patches have been decoded, or one has failed. */
  #arePatchesSettled = false;
  /** Whether the runtime has taken over: it draws further patches, and sends further events. */
  #isTaken = false;
  /** What a frozen preview displays. */
  #frozenShapes: readonly PreviewedShape[] | undefined;

  /**
   * Requests the bases, and patches that arrive soon; draws nothing yet. `insert` puts the canvas into the document.
   * Resolves to undefined if only the runtime can display the scene.
   */
  static async create(
    x3d: Element,
    bases: PrefetchedBases,
    loadFirstGroups: LoadFirstGroups,
    insert: (canvas: HTMLCanvasElement) => void,
  ): Promise<Preview | undefined> {
    const content = previewContentOf(x3d);
    if (content === undefined) return undefined;
    if (!isDrawnEarly(content.scene)) return undefined;
    for (const url of baseUrlsOf(content.scene)) bases.fetch(url); // first, since all that follows takes time
    const early = new EarlyLoading();
    // Workers start before the page is busy with the bases where the patches arrive soon after them.
    // On a fast line they have the time to fetch and compile their decoder meanwhile.
    const patches = patchBytesOf(content.scene);
    const [isFast, isSmall] = [!isLineSlow(), sumOf(patches) <= maxSmallBytes];
    if (isFast) early.workers.requestDecoder(prefetch);
    const canvas = document.createElement("canvas");
    canvas.classList.add("preview");
    canvas.ariaHidden = "true";
    insert(canvas);
    [canvas.width, canvas.height] = deviceSizeOf(canvas); // before the context, so that it allocates its buffers once
    const groups = hasLevels(content.scene) ? chooseGroups(content, canvas, early, loadFirstGroups) : undefined;
    // Larger patches would share the line and the processor with the bases.
    if (isFast && isSmall && !groups)
      for (const request of patchRequestsOf(content.scene, canvas)) early.request(request, true);
    else if (isFast || isSmall) early.workers.prepare(groups ? Infinity : patches.size);
    await Promise.resolve(); // requests go out here, before the GPU keeps the page waiting
    const context = contextOf(canvas);
    if (context !== null) return new Preview(x3d, content, bases, early, groups, canvas, context);
    early.workers.dispose();
    canvas.remove();
    return undefined;
  }

  private constructor(
    x3d: Element,
    content: PreviewContent,
    bases: PrefetchedBases,
    early: EarlyLoading,
    groups: Promise<FirstGroups | undefined> | undefined,
    canvas: HTMLCanvasElement,
    context: WebGL2RenderingContext,
  ) {
    const { promise, resolve } = Promise.withResolvers<undefined>();
    this.canvas = canvas;
    this.early = early;
    this.settled = promise;
    this.#settle = () => {
      resolve(undefined);
    };
    this.#x3d = x3d;
    this.#content = content;
    this.#renderer = new PreviewRenderer(context);
    this.#renderer.warmUp(content.scene, canvas.width, canvas.height);
    this.#followChanges();
    this.isChosen = Promise.resolve(groups?.then((chosen) => (this.#levels = chosen)));
    const files = Array.from(baseUrlsOf(content.scene), (url) => ({ url, ...bases.fetch(url) }));
    this.isNear = Promise.all(files.map(({ isNear }) => isNear));
    // If a file fails, the runtime requests it again and reports the error.
    this.#load(files).catch(() => {
      this.end();
    });
  }

  /** Call when the runtime takes over. From now on no patches are drawn. */
  hold(): void {
    this.#isTaken = true;
  }

  /** Whether all bases have been downloaded and the preview will be drawn as soon as they are decoded. */
  get isDue(): boolean {
    return this.#state === "decoding";
  }

  /**
   * Whether the patches arrive so soon that the runtime can wait until the preview has drawn them. Can become true when
   * more of the page's files have measured the line.
   */
  get canDrawPatches(): boolean {
    return arrivesSoon(this.#expectedBytes);
  }

  /** Bytes of all patches and groups; Infinity as long as it is not known which groups the view needs. */
  get #expectedBytes(): number {
    const { scene } = this.#content;
    if (!hasLevels(scene)) return sumOf(patchBytesOf(scene));
    const groups = this.#levels?.drawnRequests ?? [{ expectedBytes: Infinity }];
    return groups.reduce((sum, { expectedBytes }) => sum + expectedBytes, sumOf(patchBytesOf(scene)));
  }

  /** Requests all patches, and draws them unless the runtime takes over before. */
  drawPatches(): PatchLoading {
    this.early.scheduler.slotCount = slotCountFor(""); // until they are near, nothing else is requested
    const files = this.#request(this.#levels?.drawnRequests ?? []);
    return {
      isNear: Promise.all(files.map(({ isNear }) => isNear)),
      isSettled: this.#drawPatches(files),
    };
  }

  /**
   * Requests patches and groups, in the order in which the camera needs them, and starts the workers that decode them. A
   * file that fails is left to the runtime.
   */
  requestPatches(): void {
    this.#request(this.#levels?.requests ?? []);
  }

  #request(groups: readonly EarlyRequest[]): readonly RequestedFile[] {
    let earlyBytes = 0;
    const requests =
      this.#state === "ended"
        ? []
        : [...patchRequestsOf(this.#content.scene, this.canvas), ...groups].filter(
            ({ expectedBytes }) => (earlyBytes += expectedBytes) <= maxEarlyBytes,
          );
    // How many groups the view needs may not be known yet.
    this.early.workers.prepare(hasLevels(this.#content.scene) ? Infinity : requests.length);
    return requests.map((request) => ({ url: request.url, ...this.early.request(request) }));
  }

  /** The displayed shapes; empty until the preview has been drawn. */
  get shapes(): readonly PreviewedShape[] {
    if (this.#state !== "drawn") return [];
    if (this.#frozenShapes !== undefined) return this.#frozenShapes;
    // A shape may have several instances.
    const shapes = new Map(this.#content.scene.shapes.map((shape) => [shape.element, shape]));
    return Array.from(shapes.values(), (shape) => ({
      element: shape.element,
      ...this.#contentOf(shape),
    }));
  }

  /** Whether it displays what the runtime would display of the same bases and patches. */
  get isExact(): boolean {
    return this.#state === "drawn" && this.#content.scene.isExact;
  }

  /**
   * Frees everything but the picture, which stays and follows no further changes. Call when the runtime has loaded the
   * same, and takes over at the next change.
   */
  freeze(): void {
    if (this.#state !== "drawn" || this.#frozenShapes !== undefined) return;
    this.#frozenShapes = this.shapes;
    this.#changeListeners.abort();
    this.#renderer.freeMeshes();
    this.#freeArrays();
  }

  #freeArrays(): void {
    this.#bases.clear();
    this.#patches.clear();
    this.#levels?.clear();
  }

  /** Removes the canvas and frees the GPU. */
  end(): void {
    if (this.#state === "ended") return;
    this.#state = "ended";
    this.#listeners.abort();
    this.#changeListeners.abort();
    this.canvas.remove();
    this.#renderer.dispose();
    this.#freeArrays();
    this.#settle();
    this.onEnd();
  }

  /** Decodes the bases, unless patches that arrive at once have been decoded before. */
  async #load(files: readonly ({ readonly url: string } & PrefetchedFile)[]): Promise<void> {
    await Promise.all(files.map(({ downloaded }) => downloaded));
    if (this.#state === "waiting") this.#state = "decoding";
    const { signal } = this.#listeners;
    // Groups are requested before the page's thread is busy with their root.
    await Promise.race([this.isChosen, pause(maxChoiceMs, signal)]);
    if (arrivesAtOnce(this.#expectedBytes))
      await Promise.race([this.#patchDecoding.promise, pause(maxInstantWaitMs, signal)]);
    if (!this.#hasAllMeshes) for (const { url, decode } of files) this.#bases.set(url, (await decode()).bases);
    this.#areBasesDecoded = true;
    this.#onDecoded();
  }

  /** Draws for the first time when every shape has a mesh; ends the preview if one will never have. */
  #onDecoded(): void {
    if (this.#state !== "decoding") return;
    if (this.#hasAllMeshes) this.#drawSoon();
    else if (this.#areBasesDecoded && this.#arePatchesSettled) this.end();
  }

  /** Whether every shape has its base, or all of its patches. */
  get #hasAllMeshes(): boolean {
    const { shapes } = this.#content.scene;
    return shapes.every((shape) => this.#baseOf(shape) ?? this.#fullMeshesOf(shape));
  }

  /** Draws before the next frame. Ends the preview if that fails. */
  #drawSoon(): void {
    beforeNextFrame((isHidden) => {
      try {
        if (!isHidden) this.#drawFirstTime();
      } finally {
        if (this.#state !== "drawn") this.end();
      }
    });
  }

  /** Draws the patches when all of them have been decoded; sends `refine` where the bases have been drawn before. */
  async #drawPatches(files: readonly RequestedFile[]): Promise<void> {
    const decoded = await Promise.all(
      files.map(async (file): Promise<[string, EarlyContent]> => [file.url, await file.decoded]),
    ).catch(() => []);
    if (this.#isTaken) return;
    for (const [url, content] of decoded) {
      if ("patches" in content) this.#patches.set(url, content.patches);
      if ("group" in content) this.#levels?.add(url, content.group);
    }
    this.#arePatchesSettled = true;
    this.#patchDecoding.resolve(undefined);
    this.#onDecoded();
    if (this.#state !== "drawn" || decoded.length === 0) return; // the first drawing shows them
    await new Promise<undefined>((resolve) => {
      beforeNextFrame((isHidden) => {
        if (!isHidden && this.#state === "drawn" && this.#draw()) this.#dispatch("refine");
        resolve(undefined);
      });
    });
  }

  /** The patches of a shape, or the groups for its view, if the preview has all of them; otherwise undefined. */
  #fullMeshesOf(shape: PreviewShape): readonly PreviewMesh[] | undefined {
    const { patches, levels } = shape.geometry;
    if (hasDeformation(shape.geometry)) return undefined;
    if (levels !== undefined) {
      const meshes = this.#levels?.meshesOf(absoluteUrlOf(levels.url), this.#baseOf(shape));
      return meshes?.every((mesh) => isDrawableGroup(shape, mesh)) === true ? meshes : undefined;
    }
    const buffers = patches.map(({ data }) =>
      data && "patchIndex" in data ? this.#patches.get(absoluteUrlOf(data.url))?.[data.patchIndex] : undefined,
    );
    const areDrawable = patches.every((patch, n) => isDrawablePatch(shape, patch, buffers[n]));
    return areDrawable ? buffers.flatMap((each) => (each ? [{ buffers: each }] : [])) : undefined;
  }

  #contentOf(shape: PreviewShape): Pick<PreviewedShape, "patches" | "stage"> {
    const { levels, patches } = shape.geometry;
    if (this.#fullMeshesOf(shape) !== undefined) {
      const groups = levels && this.#levels?.groupsOf(absoluteUrlOf(levels.url));
      return { patches: groups ?? patches.map((_, patch) => patch), stage: "full" };
    }
    if (levels !== undefined) return { patches: [0], stage: "base" };
    const segments = this.#baseOf(shape)?.segments ?? [];
    return { patches: segments.flatMap((segment, patch) => (segment === undefined ? [] : [patch])), stage: "base" };
  }

  #dispatch(name: "first-image" | "refine"): void {
    const shapes = this.shapes;
    const isFull = shapes.every(({ stage }) => stage === "full");
    const send = (element: Element, stage: StageName): void => {
      if (name === "refine" && stage === "base") return;
      element.dispatchEvent(new CustomEvent(name, { detail: { stage }, bubbles: false }));
    };
    for (const { element, stage } of shapes) send(element as Element, stage);
    send(this.#x3d, isFull ? "full" : "base");
  }

  #drawFirstTime(): void {
    if (this.#state !== "decoding") return;
    const [width, height] = deviceSizeOf(this.canvas);
    this.#setSize(width, height);
    if (!this.#draw()) return;
    // Makes the canvas visible. Earlier, the compositor would wait for the GPU's warm-up, and the page for the
    // compositor.
    this.canvas.classList.add("drawn");
    this.#state = "drawn";
    this.#settle();
    this.#dispatch("first-image");
  }

  /**
   * Draws the scene. Ends the preview and returns false if the bases contradict the document or the canvas has no area.
   */
  #draw(): boolean {
    const { scene, exposure } = this.#content;
    const { width, height } = this.canvas;
    const areDrawable = scene.shapes.every(
      (shape) => this.#fullMeshesOf(shape) !== undefined || isDrawable(shape, this.#baseOf(shape)),
    );
    const meshesOf = (shape: PreviewShape): readonly PreviewMesh[] => {
      const base = this.#baseOf(shape);
      return this.#fullMeshesOf(shape) ?? (base ? [{ buffers: base.whole }] : []);
    };
    if (areDrawable && width > 0 && height > 0) this.#renderer.draw(scene, meshesOf, width, height, exposure);
    else this.end();
    return this.#state !== "ended";
  }

  /** Returns whether the size has changed. Setting the same size again would clear the canvas. */
  #setSize(width: number, height: number): boolean {
    const { canvas } = this;
    if (width === canvas.width && height === canvas.height) return false;
    canvas.width = width;
    canvas.height = height;
    return true;
  }

  #followChanges(): void {
    const { signal } = this.#changeListeners;
    this.canvas.addEventListener(
      "webglcontextlost",
      () => {
        this.end();
      },
      { signal: this.#listeners.signal },
    );
    const observer = new MutationObserver((records) => {
      if (records.some(({ target }) => isSceneNode(target, this.#x3d))) this.#update();
    });
    observer.observe(this.#x3d, { subtree: true, childList: true, attributes: true });
    signal.addEventListener("abort", () => {
      observer.disconnect();
    });
    observeDeviceSize(this.canvas, signal, (width, height) => {
      if (this.#state === "drawn" && this.#setSize(width, height)) this.#draw();
    });
  }

  #update(): void {
    const content = this.#x3d.isConnected ? previewContentOf(this.#x3d) : undefined;
    const needsOtherBases = content?.scene.shapes.some(
      ({ base }) => this.#state === "drawn" && base !== undefined && !this.#bases.has(absoluteUrlOf(base.url)),
    );
    if (content === undefined || !isDrawnEarly(content.scene) || needsOtherBases === true) {
      this.end();
      return;
    }
    this.#content = content;
    if (this.#state === "drawn") this.#draw();
  }
}
