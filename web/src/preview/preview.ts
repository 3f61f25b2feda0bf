// The preview of a scene: its base meshes, drawn before the runtime has been loaded.
// Its canvas covers the canvas of the <imgeo-view> until that displays the same shapes, or,
// where the preview displays the whole scene, until something changes. The preview follows
// changes of the document and of the element's size. It ends when its picture would differ
// from the runtime's.

import type { EarlyContent, EarlyFile, EarlyRequest } from "./earlyLoading.ts";
import { EarlyLoading } from "./earlyLoading.ts";
import type { FirstGroups } from "./firstGroups.ts";
import type { PrefetchedBases, PrefetchedFile } from "./prefetchedBases.ts";
import type { PreviewContent } from "./previewContent.ts";
import {
  baseUrlsOf,
  hasLevels,
  isDrawnEarly,
  maxSmallBytes,
  patchBytesOf,
  previewContentOf,
  sumOf,
} from "./previewContent.ts";
import type { LoadFirstGroups } from "./previewFiles.ts";
import { arrivesAtOnce, arrivesSoon, chooseGroups, maxEarlyBytes, patchRequestsOf, prefetch } from "./previewFiles.ts";
import type { PreviewedShape } from "./previewMeshes.ts";
import { PreviewMeshes } from "./previewMeshes.ts";
import { PreviewRenderer } from "./previewRenderer.ts";
import { pause } from "../scheduler/pause.ts";
import { slotCountFor } from "../scheduler/downloadSlots.ts";
import { isLineSlow } from "../workers/lineRate.ts";
import type { PreviewShape } from "./previewScene.ts";
import { contextOf } from "../render/context.ts";
import type { StageName } from "../stage/stage.ts";
import { beforeNextFrame } from "../render/frames/nextFrame.ts";
import { isSceneNode } from "../element/sceneNodes.ts";
import { deviceSizeOf, observeDeviceSize } from "../element/visibility.ts";

/** Patches that a preview draws. */
export interface PatchLoading {
  /** Resolves when little of them is still to come. */
  readonly isNear: Promise<unknown>;
  /** Resolves when the preview has drawn them, or will not. */
  readonly isSettled: Promise<unknown>;
}

/** If patches that arrive at once have not been decoded after this time, bases are drawn all the same. */
const maxInstantWaitMs = 400;

/** Roots of levels are decoded after this time, even if it is not known yet which groups the view needs. */
const maxChoiceMs = 100;

interface RequestedFile extends EarlyFile {
  readonly url: string;
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
  readonly #meshes = new PreviewMeshes();
  /** Resolves when it is known which groups of meshes with levels of detail the view needs, or cannot be known. */
  readonly isChosen: Promise<unknown>;
  readonly #settle: () => void;
  /** Resolves when the patches that drawPatches() requests have been decoded, or one has failed. */
  readonly #patchDecoding = Promise.withResolvers<undefined>();
  readonly #listeners = new AbortController();
  /** Those that follow changes of the document and of the size. */
  readonly #changeListeners = new AbortController();
  #content: PreviewContent;
  #state: "waiting" | "decoding" | "drawn" | "ended" = "waiting";
  #areBasesDecoded = false;
  /** Whether the patches have been decoded, or one has failed. */
  #arePatchesSettled = false;
  /** Whether the runtime has taken over: it draws further patches, and sends further events. */
  #isTaken = false;
  /** The stages that events have told. */
  #sentStages = "";
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
    this.isChosen = Promise.resolve(groups?.then((chosen) => (this.#meshes.groups = chosen)));
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
    const groups = this.#meshes.groups?.drawnRequests ?? [{ expectedBytes: Infinity }];
    return groups.reduce((sum, { expectedBytes }) => sum + expectedBytes, sumOf(patchBytesOf(scene)));
  }

  /** Requests all patches, and draws them unless the runtime takes over before. */
  drawPatches(): PatchLoading {
    this.early.scheduler.slotCount = slotCountFor(""); // until they are near, nothing else is requested
    const files = this.#request(this.#meshes.groups?.drawnRequests ?? []);
    return {
      isNear: Promise.all(files.map(({ isNear }) => isNear)),
      isSettled: this.#drawPatches(files),
    };
  }

  /**
   * Requests patches and groups, in the order in which the camera needs them, and starts the workers that decode them.
   * A file that fails is left to the runtime.
   */
  requestPatches(): void {
    this.#request(this.#meshes.groups?.requests ?? []);
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
    return Array.from(shapes.values(), (shape) => this.#meshes.displayedOf(shape));
  }

  /** The stages of all shapes. */
  get #stages(): string {
    return this.shapes.map(({ stage }) => stage).join();
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
    this.#meshes.clear();
  }

  /** Removes the canvas and frees the GPU. */
  end(): void {
    if (this.#state === "ended") return;
    this.#state = "ended";
    this.#listeners.abort();
    this.#changeListeners.abort();
    this.canvas.remove();
    this.#renderer.dispose();
    this.#meshes.clear();
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
    if (!this.#hasAllMeshes) for (const { url, decode } of files) this.#meshes.addBases(url, (await decode()).bases);
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
    return this.#content.scene.shapes.every((shape) => this.#meshes.has(shape));
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
    for (const [url, content] of decoded) this.#meshes.add(url, content);
    this.#arePatchesSettled = true;
    this.#patchDecoding.resolve(undefined);
    this.#onDecoded();
    if (this.#state !== "drawn" || this.#stages === this.#sentStages) return; // nothing is new
    await new Promise<undefined>((resolve) => {
      beforeNextFrame((isHidden) => {
        if (!isHidden && this.#state === "drawn" && this.#draw()) this.#dispatch("refine");
        resolve(undefined);
      });
    });
  }

  #dispatch(name: "first-image" | "refine"): void {
    const send = (element: Element, stage: StageName): void => {
      if (name === "refine" && stage === "base") return;
      element.dispatchEvent(new CustomEvent(name, { detail: { stage }, bubbles: false }));
    };
    for (const { element, stage } of this.shapes) send(element as Element, stage);
    this.#sentStages = this.#stages;
    send(this.#x3d, this.#stages.includes("base") ? "base" : "full");
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
    const areDrawable = scene.shapes.every((shape) => this.#meshes.meshesOf(shape) !== undefined);
    const meshesOf = (shape: PreviewShape) => this.#meshes.meshesOf(shape) ?? [];
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
      (shape) => this.#state === "drawn" && !this.#meshes.knowsBase(shape),
    );
    if (content === undefined || !isDrawnEarly(content.scene) || needsOtherBases === true) {
      this.end();
      return;
    }
    this.#content = content;
    if (this.#state === "drawn") this.#draw();
  }
}
