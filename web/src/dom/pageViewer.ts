// The viewer of a page's <x3d>: follows changes of its elements, displays the scene on the
// canvas of the <imgeo-view>, loads its files, and sends events to its elements.

import type { DeliveryError } from "../delivery/deliveryError.ts";
import type { LevelStatistics } from "../delivery/geometryView.ts";
import { requireHttp } from "../delivery/inlinedDocument.ts";
import type { SceneDeliveries } from "../delivery/requestWithinBudget.ts";
import type { AnchorDescription } from "../document/description.ts";
import type { PartName } from "../document/parts.ts";
import { minBatchedInstances } from "../document/parts.ts";
import { interpolatorIdOf } from "../document/sequence.ts";
import { CameraController } from "../navigation/cameraController.ts";
import type { EarlyLoading } from "../preview/earlyLoading.ts";
import type { Preview } from "../preview/preview.ts";
import type { PreviewedShape } from "../preview/previewMeshes.ts";
import type { Hit } from "../render/picking/picker.ts";
import type { RenderStatistics } from "../render/sceneRenderer.ts";
import { SceneRenderer } from "../render/sceneRenderer.ts";
import type { SceneChanges } from "../render/shapes/shapeChanges.ts";
import { hasEnvironment } from "../scene/environmentIn.ts";
import { shapeInstancesIn } from "../scene/shapeInstances.ts";
import { slotCountFor } from "../scheduler/downloadSlots.ts";
import { Scheduler } from "../scheduler/scheduler.ts";
import type { Stage, StageName } from "../stage/stage.ts";
import { FontLoading } from "../text/fontLoading.ts";
import type { ViewerHost } from "../viewer/viewerCore.ts";
import { sceneDeliveriesOf, ViewerCore } from "../viewer/viewerCore.ts";
import { touchWritten } from "../viewer/writtenElements.ts";
import { pageWorkers } from "../workers/pageWorkers.ts";
import type { WorkerPool } from "../workers/workerPool.ts";
import { DocumentObserver } from "./documentObserver.ts";
import { DisplayedScene } from "./displayedScene.ts";
import { inlinedRoots, inlinedTitle, inlineOf } from "./inlinedRoots.ts";
import type { LoadingEvents } from "./loadingEvents.ts";
import { lowestStageOf } from "./loadingEvents.ts";
import { watchNetworkProtocol } from "./networkProtocol.ts";
import { PageSurroundings } from "./pageSurroundings.ts";
import { PageInlines } from "./pageInlines.ts";
import { pageParts } from "./pageParts.ts";
import { absoluteUrlOf, makePagePool } from "./pagePool.ts";
import type { PageShape } from "./pageShapes.ts";
import { PageShapes } from "./pageShapes.ts";
import type { DocumentChange } from "./sceneAnimation.ts";
import { SceneAnimation } from "./sceneAnimation.ts";
import { SceneLoading } from "./sceneLoading.ts";
import { sceneSpaceOf } from "./sceneSpace.ts";
import { ShapeVisibility } from "./shapeVisibility.ts";
import { TextureReadTest } from "./textureReadTest.ts";
import { beginsWithWalk, followNavigationType } from "./walkingPart.ts";

export interface ViewStatistics extends RenderStatistics {
  /** Requests ever sent, retries included. */
  readonly requests: number;
  readonly openRequests: number;
  /** Meshes with levels of detail. */
  readonly levels: LevelStatistics;
}

export interface PageViewerListener {
  /** `share`: 0 … 1 of the bytes of all files. `stage`: what the last frame displays. */
  onProgress(share: number, stage: StageName | "none"): void;
  /** A frame has been drawn, or is shown by the preview. The events that wait for it follow. */
  onFrame(): void;
  /** Whether the preview shows the picture that the next requested frame would have. */
  isShownByPreview(): boolean;
  /** Another viewpoint is bound, another navigation type is in use, or the scene has other ones to choose from. */
  onNavigation(): void;
  /** The scene has been read again and has Anchors, or had some before. */
  onAnchors(anchors: readonly AnchorDescription[]): void;
  /** Whether nothing but the scene is still to be loaded for the view. A frame is requested when that changes. */
  maySettle(): boolean;
}

export class PageViewer {
  readonly renderer: SceneRenderer;
  readonly cameraController: CameraController;
  readonly #x3d: Element;
  readonly #canvas: HTMLCanvasElement;
  readonly #scheduler: Scheduler;
  readonly #workers: WorkerPool;
  readonly #early: EarlyLoading | undefined;
  readonly #deliveries: SceneDeliveries;
  readonly #core: ViewerCore<PageShape>;
  readonly #shapes: PageShapes;
  readonly #inlines = new PageInlines();
  readonly #surroundings: PageSurroundings;
  readonly #observer: DocumentObserver;
  readonly #listeners = new AbortController();
  readonly #listener: PageViewerListener;
  /** Whether a preview has displayed the scene, and so decoded the bases. */
  readonly #isPreviewed: boolean;
  readonly #textureTest: TextureReadTest;
  readonly #loading: SceneLoading;
  #isLoading = false;
  readonly #displayed: DisplayedScene;
  readonly #animation: SceneAnimation;
  readonly #shapeVisibility = new ShapeVisibility();

  /** `preview`: displays shapes, and has begun to load patches. */
  constructor(
    x3d: Element,
    canvas: HTMLCanvasElement,
    context: WebGL2RenderingContext,
    listener: PageViewerListener,
    preview: Pick<Preview, "shapes" | "early"> | undefined,
  ) {
    const previewed = preview?.shapes ?? [];
    this.#early = preview?.early;
    this.#scheduler = this.#early?.scheduler ?? new Scheduler(slotCountFor(""));
    this.#scheduler.slotCount = slotCountFor("");
    this.#workers = this.#early?.workers ?? pageWorkers();
    this.#x3d = x3d;
    this.#canvas = canvas;
    this.#listener = listener;
    this.#isPreviewed = previewed.length > 0;
    this.#loading = new SceneLoading(
      x3d,
      () => ({ core: this.#core, shapes: this.#shapes, inlines: this.#inlines, surroundings: this.#surroundings }),
      previewStageOf(previewed),
      listener,
    );
    this.cameraController = new CameraController(
      () => {
        this.renderer.frames.request();
      },
      () => {
        followNavigationType(this.cameraController, pageParts().walking, this.#core.log, () => {
          if (!this.#listeners.signal.aborted) this.renderer.frames.request();
        });
        listener.onNavigation();
      },
    );
    this.renderer = new SceneRenderer(
      canvas,
      context,
      this.cameraController,
      {
        onFrame: () => {
          this.#onFrame();
        },
        isShownElsewhere: () => listener.isShownByPreview(),
      },
    );
    this.#textureTest = new TextureReadTest(this.renderer);
    const pool = makePagePool(this.renderer, this.#scheduler, this.#workers, {
      early: this.#early,
      readsTextures: () => this.#textureTest.readsTextures,
      onTransfer: () => {
        this.#loading.requestProgress();
      },
    });
    const deliveries = (this.#deliveries = sceneDeliveriesOf(pool));
    this.#shapes = new PageShapes(
      this.renderer,
      deliveries,
      {
        onStage: (stage) => {
          this.#onStage(stage);
        },
        onError: (error, element, loading) => {
          this.#fail(error, element, loading);
        },
        maySettle: () => !this.#textureTest.isPending,
      },
      previewed,
    );
    this.#surroundings = new PageSurroundings(this.renderer.scene.surroundings, deliveries.textures, {
      onError: (error, element) => {
        this.#fail(error, element);
      },
      onSettled: () => {
        this.renderer.frames.request();
      },
    });
    this.#displayed = new DisplayedScene({
      renderer: this.renderer,
      cameraController: this.cameraController,
      surroundings: this.#surroundings,
      requestFiles: () => {
        this.#core.control.request();
      },
      onAnchors: (anchors) => {
        listener.onAnchors(anchors);
      },
      warn: (message) => {
        this.#warn(message);
      },
    });
    const fonts = new FontLoading(
      document.fonts,
      () => {
        this.#core.reader.touchTexts();
        this.#core.read();
      },
      this.#listeners.signal,
    );
    this.#core = new ViewerCore<PageShape>({
      x3d,
      pool,
      deliveries,
      shapes: this.#shapes,
      reader: { levelOf: (lod) => this.#displayed.levelOf(lod) },
      fontEditionOf: (font, text) => fonts.editionOf(font, text),
      inlines: {
        urlOf: (url) => {
          const absoluteUrl = absoluteUrlOf(url);
          requireHttp(absoluteUrl);
          return absoluteUrl;
        },
      },
      parts: pageParts(),
      host: this.#makeHost(),
    });
    if (!this.#textureTest.readsTextures) this.#warnOfInexactImages();
    this.#observer = new DocumentObserver(x3d, (records) => {
      this.#follow(this.#animation.follow(records));
    });
    this.#animation = new SceneAnimation(x3d, {
      documentOf: (inline) => this.#core.inlines.documentOf(inline)?.x3d as Element | undefined,
      movePoses: (changes) => {
        this.#displayed.movePoses(changes);
        this.#core.followMoves();
      },
      moveVertices: ({ element, field, type, value }) =>
        type.isList && type.size > 0 && this.#core.reader.moveVertices(element, field, value as readonly number[]),
      read: (changes) => {
        this.#readChanges(changes);
      },
      drawFrame: () => {
        this.renderer.draw();
      },
      showFraction: (interpolator, fraction) => {
        deliveries.geometries.setFraction(interpolatorIdOf(interpolator), fraction);
      },
      sequenceDurationOf: (element) => deliveries.geometries.sequenceDurationOf(interpolatorIdOf(element)),
      onMotion: (visitMoments) => {
        this.#core.whenDisplayed(() => {
          this.#displayed.showMotion(this.#core.scene, visitMoments);
        });
      },
      withoutReports: (write) => {
        this.#observer.writeUnobserved(write);
      },
      touch: (element) => {
        this.#core.reader.touch(element);
      },
      ...sceneSpaceOf(x3d, canvas, this.renderer, this.cameraController, (root) => inlineOf(this.#core, root)),
      warn: (message) => {
        this.#core.log.warn(message);
      },
    });
  }

  /** Reads what a script has changed. */
  #follow(records: readonly MutationRecord[]): void {
    if (records.length === 0) return;
    const { reader } = this.#core;
    for (const { target, type, attributeName } of records) {
      if (type === "childList") reader.rearrange(target as Element);
      else reader.touchAttribute(target as Element, attributeName);
    }
    this.#core.read();
    this.#core.whenDisplayed(() => {
      for (const { target, attributeName } of records) this.#displayed.followBind(target as Element, attributeName);
    });
  }

  /** Reads attributes that animation has written. */
  #readChanges(changes: readonly DocumentChange[]): void {
    for (const { element } of changes) touchWritten(this.#core.reader, this.#x3d, element);
    this.#core.read();
    this.#core.whenDisplayed(() => {
      for (const { element, attribute } of changes) this.#displayed.followBind(element, attribute);
    });
  }

  /** Follows the document from now on. */
  start(): void {
    const { signal } = this.#listeners;
    // The renderer handles both events first: its listeners were added earlier.
    this.#canvas.addEventListener(
      "webglcontextlost",
      () => {
        this.#onContextLost();
      },
      { signal },
    );
    this.#canvas.addEventListener(
      "webglcontextrestored",
      () => {
        this.#deliverAgain();
      },
      { signal },
    );
    watchNetworkProtocol(signal, (protocol) => {
      this.#scheduler.slotCount = slotCountFor(protocol);
    });
    this.#observer.start();
    this.#core.read();
    this.#animation.start();
  }

  /** `isPaused`: animation stands. `mayStartByItself`: clocks run that no event has started. */
  setMotion(isPaused: boolean, mayStartByItself: boolean): void {
    this.#animation.setMotion(isPaused, mayStartByItself);
  }

  /** Makes all sequences display the frame at this time, in seconds; undefined: they follow their interpolators. */
  setSequenceTime(seconds: number | undefined): void {
    this.#deliveries.geometries.setSequenceTime(seconds);
  }

  /** Requests files from now on. */
  load(): void {
    this.#isLoading = true;
    this.#core.load();
    this.#early?.dropFiles("patches"); // the others are not needed now
    this.#workers.prepare(this.#shapes.workerJobCount);
    if (this.#shapes.hasCompact) this.#workers.requestDecoder();
    this.renderer.frames.request();
  }

  /** Call when everything has been loaded. */
  onComplete(): void {
    this.#early?.dropFiles();
  }

  /** Whether all patches that a preview displays are displayed by the runtime, or have failed. */
  displays(shapes: readonly PreviewedShape[]): boolean {
    return this.#core.isDisplayed && shapes.every((shape) => this.#shapes.displays(shape));
  }

  /** Whether the runtime displays more of these shapes than a preview. */
  refines(shapes: readonly PreviewedShape[]): boolean {
    return shapes.some((shape) => this.#shapes.refines(shape));
  }

  /** The title of the first inlined document that has one; undefined if there is none, or none has loaded. */
  get inlinedTitle(): string | undefined {
    return inlinedTitle(this.#core);
  }

  /**
   * Whether the shape with this DEF or id is visible, inlined documents included; undefined if there is none. Of
   * several instances one is enough.
   */
  isShapeVisible(name: string): boolean | undefined {
    return this.#core.scene && this.#shapeVisibility.isVisible(this.#core.scene, name);
  }

  /** Sets the GPU memory, in bytes, that vertex data and textures may take. */
  setBudget(bytes: number): void {
    this.#core.control.setBudget(bytes);
  }

  /** Refines levels of detail around a point of the scene first; undefined: by the view alone. */
  refineAt(point: readonly [number, number, number] | undefined): void {
    this.#core.control.setFocus(point);
  }

  get statistics(): ViewStatistics {
    const { startedCount: started, runningCount: running, waitingCount: waiting } = this.#scheduler;
    return {
      ...this.renderer.statistics,
      isFrameDue: this.renderer.statistics.isFrameDue || this.#core.isLoadingParts,
      requests: started,
      openRequests: running + waiting,
      levels: this.#deliveries.geometries.levelStatistics,
    };
  }

  /** The hit at a pixel of the canvas' buffer; in an inlined document its element is the Inline. Waits for the GPU. */
  pick(x: number, y: number): Hit | undefined {
    return this.renderer.picker.pick(x, y);
  }

  pickAsync(x: number, y: number): Promise<Hit | undefined> {
    return this.renderer.picker.pickAsync(x, y);
  }

  /** Aborts all requests and frees the GPU. */
  dispose(): void {
    this.#listeners.abort();
    this.#observer.stop();
    this.#animation.dispose();
    this.#core.dispose();
    this.#loading.dispose();
    this.#workers.dispose();
    this.renderer.dispose();
  }

  #makeHost(): ViewerHost {
    return {
      beforeRead: () => {
        this.#animation.writeAttributes();
      },
      partsFor: ({ root, navigation }) => {
        const parts: PartName[] = shapeInstancesIn(root) < minBatchedInstances ? [] : ["batches"];
        if (hasEnvironment(root)) parts.push("environment");
        if (beginsWithWalk(navigation)) parts.push("walking");
        return parts;
      },
      onPartsNeeded: () => {
        this.#loading.join();
      },
      onPartsFailed: (error) => {
        this.#loading.fail(error, this.#x3d);
        this.renderer.frames.request(); // after which the scene is complete, as without any other file
      },
      view: () => this.renderer.view,
      sceneTextures: () => this.#surroundings.textureKeys,
      takeMoved: () => this.renderer.scene.shapes.takeMoved(),
      display: (scene) => this.#displayed.display(scene),
      onShapes: (changes) => {
        this.#onShapes(changes);
      },
      onScene: () => {
        this.#followLods();
      },
      onRequests: () => {
        this.#onRequests();
      },
      onInlineRequested: (inline) => {
        this.#inlines.onRequested(inline, () => this.#core.inlines.transfersOf(inline));
      },
      onInlineEnd: (inline, error) => {
        this.#inlines.onEnd(inline, error, (failure, element, loading) => {
          this.#fail(failure, element, loading);
        });
      },
      onInlineRead: () => {
        this.#animation.followInlined(inlinedRoots(this.#core));
        this.#listener.onNavigation(); // the title may be the document's
      },
      onInlineRemoved: (inline) => {
        this.#animation.followInlined(inlinedRoots(this.#core));
        this.#inlines.onRemoved(inline);
      },
    };
  }

  #onShapes({ shapes }: SceneChanges): void {
    const hasBase = Array.from(shapes.values()).some(({ geometry }) => geometry?.base !== undefined);
    if (hasBase && !this.#isPreviewed) this.#workers.prepareMainThread();
    this.#loading.join();
  }

  /** Reads the scene again if the camera's distance to a LOD requires another level. */
  #followLods(): void {
    this.#displayed.followLods((changed) => {
      for (const lod of changed) this.#core.reader.touch(lod);
      this.#core.read();
    });
  }

  #onStage(stage: Stage | undefined): void {
    this.#displayed.followSphere();
    this.#textureTest.onStage(stage);
  }

  #onRequests(): void {
    this.#shapes.settle();
    this.#loading.requestProgress();
  }

  /**
   * The few GPUs that fail the test display a wrong shape for as long as it takes; then all files are fetched again,
   * and decoded in workers.
   */
  async #testTextures(): Promise<void> {
    const hasFailed = await this.#textureTest.run();
    if (this.#listeners.signal.aborted) return;
    if (hasFailed) {
      this.#warnOfInexactImages();
      this.#shapes.suspend();
      this.#deliverAgain();
    }
    this.#onRequests();
  }

  #warnOfInexactImages(): void {
    this.#warn("images cannot be read exactly on this GPU; vertices are decoded in workers");
  }

  /** Everything on the GPU is lost, and what is requested now could not be uploaded. */
  #onContextLost(): void {
    this.#warn("has lost its WebGL context; the scene is displayed again when the browser restores it");
    this.#shapes.suspend();
    this.#surroundings.suspend();
    this.renderer.uploads.freeSpares();
  }

  /** Fetches all files again, usually from the browser's cache. Events that have been sent are not sent again. */
  #deliverAgain(): void {
    this.#shapes.join();
    this.#surroundings.follow();
    this.#core.control.request();
    this.renderer.frames.request();
  }

  /** `loading`: the events of the shape or Inline that the file belongs to. */
  #fail(error: DeliveryError, element: Element, loading?: LoadingEvents): void {
    this.#core.log.error(error.message);
    this.#loading.fail(error, element, loading);
  }

  #onFrame(): void {
    if (this.#core.scene === undefined) return; // an empty frame while the scene's parts of the runtime are loaded
    this.#listener.onFrame();
    this.#animation.onFrame();
    if (!this.#isLoading) return;
    this.#loading.onFrame();
    this.#followLods();
    this.#core.control.followCamera();
    if (this.#textureTest.isDue) void this.#testTextures();
  }

  #warn(message: string): void {
    this.#core.log.warn(`<${this.#x3d.localName}> ${message}`);
  }
}

/** The stage that all previewed shapes display. */
function previewStageOf(previewed: readonly PreviewedShape[]): StageName | "none" {
  return lowestStageOf(previewed.map(({ stage }) => stage));
}
