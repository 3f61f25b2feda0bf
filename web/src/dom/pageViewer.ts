// Joins a document to a picture: reads the scene whenever the document changes,
// says what to load of it, and tells the page.

import { FontLoading } from "../text/fontLoading.ts";
import { measureRun } from "../text/glyphRendering.ts";
import type { StageName } from "../stage/stage.ts";
import type { DeliveryError } from "../delivery/deliveryError.ts";
import type { Transfer } from "../delivery/progress.ts";
import { progressOf } from "../delivery/progress.ts";
import { ResourcePool } from "../delivery/resourcePool.ts";
import { GeometryDeliveries } from "../delivery/geometryDeliveries.ts";
import { TextureDeliveries } from "../delivery/textureDeliveries.ts";
import type { AnchorDescription, SceneDescription } from "../document/description.ts";
import type { SceneElement } from "../document/element.ts";
import { readInlineGeometry } from "../document/inlineGeometry.ts";
import { SceneReader } from "../document/sceneReader.ts";
import { textReader } from "../text/textGeometry.ts";
import type { NavigatedScene } from "../navigation/cameraController.ts";
import { CameraController } from "../navigation/cameraController.ts";
import type { LodInstance } from "../scene/instances.ts";
import { LodSelection } from "../scene/lodSelection.ts";
import type { Hit } from "../render/picking/picker.ts";
import type { RenderStatistics } from "../render/sceneRenderer.ts";
import { SceneRenderer } from "../render/sceneRenderer.ts";
import { defaultDownloadOptions } from "../scheduler/download.ts";
import { Scheduler } from "../scheduler/scheduler.ts";
import { slotCountFor } from "../scheduler/downloadSlots.ts";
import { pageWorkers } from "../workers/pageWorkers.ts";
import { UploadPipeline } from "../viewer/uploadPipeline.ts";
import type { PreviewedShape } from "../preview/preview.ts";
import { takePrefetchedBases } from "../preview/previewRegistry.ts";
import { PageInlines } from "./pageInlines.ts";
import { LoadingEvents } from "./loadingEvents.ts";
import { isSceneNode } from "../element/sceneNodes.ts";
import { watchNetworkProtocol } from "./networkProtocol.ts";
import { PageShapes, displayedStageOf } from "./pageShapes.ts";
import { DeliveryControl } from "../viewer/deliveryControl.ts";

/** The bar moves no more often than people can see. */
const progressIntervalMs = 50;

/** LODs in LODs whose levels are chosen at once; deeper ones after the next frame. */
const mostNestedLevels = 8;

export interface ViewStatistics extends RenderStatistics {
  /** Requests ever sent, retries included. */
  readonly requests: number;
  readonly openRequests: number;
}

/** Who shows what the viewer knows. */
export interface PageViewerListener {
  onProgress(share: number, stage: StageName | "none"): void;
  /** After each frame, before the events that wait for it. */
  onFrame(): void;
  /** Another viewpoint is bound, or one moves in another way; or the scene has changed what there is of both. */
  onNavigation(): void;
  /** The scene has other links than before. */
  onAnchors(anchors: readonly AnchorDescription[]): void;
}

export class PageViewer {
  readonly renderer: SceneRenderer;
  readonly navigator: CameraController;
  readonly #x3d: Element;
  readonly #canvas: HTMLCanvasElement;
  readonly #scheduler = new Scheduler(slotCountFor(""));
  readonly #pool: ResourcePool;
  readonly #deliveries: GeometryDeliveries;
  readonly #textures: TextureDeliveries;
  readonly #workers = pageWorkers();
  readonly #reader: SceneReader;
  readonly #shapes: PageShapes;
  readonly #inlines: PageInlines;
  readonly #levels = new LodSelection();
  readonly #steering: DeliveryControl;
  readonly #observer: MutationObserver;
  readonly #listeners = new AbortController();
  readonly #listener: PageViewerListener;
  readonly #logged = new Set<string>();
  /** By a first look, which has decoded the bases. */
  readonly #wasShown: boolean;
  /** Believed of every GPU that has the units for it, until the trial. */
  #readsTextures: boolean;
  /** Due with the first picture of textures. Until it has ended nothing is complete. */
  #trial: "needless" | "due" | "running" | "ended" = "needless";
  #loading: LoadingEvents;
  #isLoading = false;
  #built: (NavigatedScene & { readonly levels: readonly LodInstance[] }) | undefined;
  #scene: SceneDescription | undefined;
  #hasAnchors = false;
  #progressTimer: ReturnType<typeof setTimeout> | undefined;

  readonly #transfers = (): Readonly<Transfer>[] => [
    ...this.#deliveries.transfers(),
    ...this.#textures.transfers(),
    ...this.#inlines.transfers,
  ];

  /** `shown`: what people see of the scene already, by other means. */
  constructor(
    x3d: Element,
    canvas: HTMLCanvasElement,
    context: WebGL2RenderingContext,
    listener: PageViewerListener,
    shown: readonly PreviewedShape[] = [],
  ) {
    this.#x3d = x3d;
    this.#canvas = canvas;
    this.#listener = listener;
    this.#wasShown = shown.length > 0;
    this.#loading = new LoadingEvents(x3d, this.#transfers, shown.length > 0 ? "base" : "none");
    this.navigator = new CameraController(
      () => {
        this.renderer.requestFrame();
      },
      () => {
        listener.onNavigation();
      },
    );
    this.renderer = new SceneRenderer(canvas, context, this.navigator, () => {
      this.#onFrame();
    });
    this.#readsTextures = this.renderer.mayReadTextures;
    if (!this.#readsTextures) this.#warnOfGpu();
    const arrival = new UploadPipeline(this.renderer);
    // What is no URL is left for the request to fail on.
    const resolve = (url: string) => (URL.canParse(url, document.baseURI) ? new URL(url, document.baseURI).href : url);
    this.#pool = new ResourcePool({
      scheduler: this.#scheduler,
      makeImage: (png, signal) => arrival.makeImage(png, signal),
      readsTextures: () => Promise.resolve(this.#readsTextures),
      maxTextureSize: this.renderer.largestTexture,
      runJob: (name, input, signal) => this.#workers.run(name, input, signal),
      runOnMainThread: (name, input, signal) => this.#workers.runOnMainThread(name, input, signal),
      makePicture: (bytes, sampling, signal) => arrival.makePicture(bytes, sampling, signal),
      storeBytes: (array, use, signal) => arrival.storeBytes(array, use, signal),
      download: defaultDownloadOptions,
      prefetchedBases: takePrefetchedBases,
      resolve,
      onTransfer: () => {
        this.#progressSoon();
      },
    });
    this.#deliveries = new GeometryDeliveries(this.#pool);
    this.#textures = new TextureDeliveries(this.#pool);
    this.#shapes = new PageShapes(
      this.renderer,
      this.#deliveries,
      this.#textures,
      {
        onStage: (stage) => {
          this.#followSphere();
          if (stage?.kind === "textures" && this.#trial === "needless") this.#trial = "due";
        },
        onError: (error, element, loading) => {
          this.#fail(error, element, loading);
        },
        maySettle: () => this.#trial !== "due" && this.#trial !== "running",
      },
      shown.map(({ element }) => element),
    );
    this.#inlines = new PageInlines(this.#pool, resolve, {
      onChange: (inline) => {
        this.#reader.touch(inline);
        this.#readDocument();
      },
      onError: (error, element, loading) => {
        this.#fail(error, element, loading);
      },
    });
    const fonts = new FontLoading(
      document.fonts,
      () => {
        this.#reader.touchTexts();
        this.#readDocument();
      },
      this.#listeners.signal,
    );
    this.#reader = new SceneReader(x3d, {
      inlined: (inline) => this.#inlines.documentOf(inline),
      levelOf: (lod) => this.#levels.levelOf(lod),
      inlineGeometry: readInlineGeometry,
      text: textReader(measureRun, (font, letters) => fonts.editionOf(font, letters)),
    });
    this.#steering = new DeliveryControl(
      this.renderer,
      { geometries: this.#deliveries, textures: this.#textures },
      () => {
        this.#onSteered();
      },
    );
    this.#observer = new MutationObserver((all) => {
      const records = all.filter(({ target }) => isSceneNode(target, x3d));
      if (records.length === 0) return;
      for (const { target, type } of records) {
        if (type === "childList") this.#reader.rearrange(target as Element);
        else this.#reader.touch(target as Element);
      }
      this.#readDocument();
      for (const { target, attributeName } of records) this.#followBind(target as Element, attributeName);
    });
  }

  /** Follows the document from now on. */
  start(): void {
    const { signal } = this.#listeners;
    // The renderer has heard of it before: its listeners are older.
    this.#canvas.addEventListener(
      "webglcontextlost",
      () => {
        this.#loseContext();
      },
      { signal },
    );
    this.#canvas.addEventListener(
      "webglcontextrestored",
      () => {
        this.#deliverAll();
      },
      { signal },
    );
    watchNetworkProtocol(signal, (protocol) => {
      this.#scheduler.slotCount = slotCountFor(protocol);
    });
    this.#observer.observe(this.#x3d, { subtree: true, childList: true, attributes: true });
    this.#readDocument();
  }

  /** Asks for files from now on. */
  load(): void {
    this.#isLoading = true;
    this.#inlines.follow(this.#scene?.inlines ?? []);
    this.#steering.start();
    this.#workers.prepare(this.#shapes.jobsToCome);
    this.renderer.requestFrame();
  }

  /** Whether the last frame has at least these. */
  shows(shapes: readonly PreviewedShape[]): boolean {
    return shapes.every(({ element, patches }) => this.#shapes.shows(element, patches));
  }

  /** Of vertex data and textures on the GPU, in bytes. */
  setBudget(bytes: number): void {
    this.#steering.setBudget(bytes);
  }

  get statistics(): ViewStatistics {
    const { started, running, waiting } = this.#scheduler;
    return { ...this.renderer.statistics, requests: started, openRequests: running + waiting };
  }

  /** What is seen at a pixel of the canvas' buffer; of an inlined document its Inline. */
  pick(x: number, y: number): Hit | undefined {
    return this.renderer.pick(x, y);
  }

  pickSoon(x: number, y: number): Promise<Hit | undefined> {
    return this.renderer.pickAsync(x, y);
  }

  /** Aborts all requests and frees the GPU. */
  dispose(): void {
    this.#listeners.abort();
    this.#observer.disconnect();
    this.#steering.stop();
    this.#inlines.dispose();
    this.#shapes.dispose();
    this.#loading.abandon();
    this.#workers.dispose();
    this.renderer.dispose();
  }

  /**
   * After the first picture, so that nobody waits for it. The few GPUs that fail show
   * a wrong shape for as long as this takes; then all is fetched anew, for workers.
   */
  async #tryTextures(): Promise<void> {
    this.#trial = "running";
    const reads = await this.renderer.readsTextures();
    this.#trial = "ended";
    if (this.#listeners.signal.aborted) return;
    if (!reads && !this.renderer.isContextLost) {
      this.#readsTextures = false;
      this.#warnOfGpu();
      this.#shapes.clear();
      this.#deliverAll();
    }
    this.#onSteered();
  }

  #warnOfGpu(): void {
    this.#warn(this.#x3d, "images cannot be read exactly on this GPU; vertices are decoded in workers");
  }

  /** `round`: how often it has been read for the levels of the reading before. */
  #readDocument(round = 0): void {
    const before = this.#scene;
    const scene = (this.#scene = this.#reader.read());
    if (scene === before) return;
    const built = this.renderer.setScene(scene);
    if (built.anchors.length > 0 || this.#hasAnchors) this.#listener.onAnchors(built.anchors);
    this.#hasAnchors = built.anchors.length > 0;
    const leave = this.#shapes.follow(built.changes);
    const hasBase = Array.from(built.changes.shapes.values()).some(({ geometry }) => geometry?.base !== undefined);
    if (hasBase && !this.#wasShown) this.#workers.prepareMainThread();
    this.#tellNavigator({ ...built, navigation: scene.navigation });
    if (this.#shapes.isLoading && this.#loading.isEnded) this.#loading = new LoadingEvents(this.#x3d, this.#transfers);
    this.#steering.follow(scene.chunkPriority, built.changes, (problem) => {
      this.#warn(this.#x3d, `chunkPriority: ${problem}`);
    });
    for (const { element, message } of scene.warnings) this.#warn(element, message);
    leave(); // last, so that files that old and new shapes share are not fetched again
    if (this.#isLoading && scene.inlines !== before?.inlines) this.#inlines.follow(scene.inlines);
    this.#followLevels(round); // before what has been asked for here is sent
  }

  #tellNavigator(built: NavigatedScene & { readonly levels: readonly LodInstance[] }): void {
    const before = this.#built;
    this.#built = built;
    const isSame =
      before?.sphere === built.sphere &&
      before.navigation === built.navigation &&
      isSameList(before.viewpoints, built.viewpoints);
    if (!isSame) this.navigator.setScene(built);
  }

  /** The scene is another where a LOD shows another level. */
  #followLevels(round = 0): void {
    if (this.#built === undefined || round > mostNestedLevels) return;
    const changed = this.#levels.update(this.#built.levels, this.navigator.pose.position);
    for (const lod of changed) this.#reader.touch(lod);
    if (changed.length > 0) this.#readDocument(round + 1);
  }

  /** set_bind is an event: it counts whenever it is written, even if it reads as before. */
  #followBind(element: Element, attribute: string | null): void {
    if (attribute === null || !/^(set_)?bind$/i.test(attribute)) return;
    this.navigator.bind(element, element.getAttribute(attribute)?.trim().toLowerCase() === "true");
  }

  /** The scene reaches as far as what has come of it. */
  #followSphere(): void {
    const { sphere } = this.renderer;
    if (this.#built === undefined || this.#built.sphere === sphere) return;
    this.#built = { ...this.#built, sphere };
    this.navigator.setScene(this.#built);
  }

  #onSteered(): void {
    this.#shapes.settle();
    this.#progressSoon();
  }

  /** All that was on the GPU is gone. What is asked for now would come to nothing. */
  #loseContext(): void {
    this.#warn(this.#x3d, "has lost its WebGL context, which the browser took; it comes back with it");
    this.#shapes.clear();
  }

  /** Everything is fetched once more, from the browser's cache as a rule. Events go on where they were. */
  #deliverAll(): void {
    this.#shapes.deliverAll();
    this.#steering.request();
    this.renderer.requestFrame();
  }

  #fail(error: DeliveryError, element: Element, loading: LoadingEvents): void {
    this.#logOnce("error", error.message);
    const detail = { type: error.kind, url: error.url, element, message: error.message };
    loading.fail(detail, error);
    this.#loading.fail(detail, error);
  }

  #progressSoon(): void {
    this.#progressTimer ??= setTimeout(() => {
      this.#tellProgress();
    }, progressIntervalMs);
  }

  #tellProgress(): void {
    clearTimeout(this.#progressTimer);
    this.#progressTimer = undefined;
    this.#shapes.tellProgress();
    if (!this.#loading.isEnded) this.#loading.moveOn(progressOf(this.#transfers(), this.#loading.progress));
    this.#listener.onProgress(this.#loading.progress.totalProgress, this.#loading.stage);
  }

  #onFrame(): void {
    this.#listener.onFrame();
    if (!this.#isLoading) return;
    if (!this.#shapes.isQuiet || !this.#inlines.isQuiet || !this.#loading.isEnded) this.#tellPage();
    this.#followLevels();
    this.#steering.followCamera();
    if (this.#trial === "due") void this.#tryTextures();
  }

  /** What a frame with everything that has come so far has shown. */
  #tellPage(): void {
    const awaited = [...this.#shapes.awaited, ...this.#inlines.loadings];
    // Shapes of which nothing will come do not hold the scene back.
    this.#loading.reach(
      displayedStageOf(
        awaited.filter(({ stage, isSettled }) => stage !== "none" || !isSettled).map(({ stage }) => stage),
      ),
    );
    this.#tellProgress(); // all of it, and of what is seen, before `load`
    // Asked for only now: until a frame has shown the end, further shapes may join.
    if (awaited.every((loading) => loading.isSettled)) this.#loading.settle();
    this.#shapes.onFrame();
    for (const loading of this.#inlines.loadings) loading.onFrame(false);
    this.#loading.onFrame(true);
  }

  #warn(element: SceneElement, message: string): void {
    this.#logOnce("warn", `<${element.localName}> ${message}`);
  }

  /** One line for each thing, however many shapes it concerns and however often the document is read. */
  #logOnce(level: "warn" | "error", message: string): void {
    if (this.#logged.has(message)) return;
    this.#logged.add(message);
    console[level](`imgeo: ${message}`);
  }
}

function isSameList<Item>(a: readonly Item[], b: readonly Item[]): boolean {
  return a.length === b.length && a.every((item, place) => item === b[place]);
}
