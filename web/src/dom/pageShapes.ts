// The shapes of a page's scene: passes the stages and pictures that load to the renderer,
// and sends the events and settles the promises of their elements.

import { DeliveryError } from "../delivery/deliveryError.ts";
import { needsWorkers } from "../delivery/encodings/encodings.ts";
import { progressOf } from "../delivery/progress.ts";
import type { SceneDeliveries } from "../delivery/requestWithinBudget.ts";
import type { TextureImage } from "../delivery/content.ts";
import type {
  AppearanceDescription,
  CubeMapPicture,
  CubeMapRole,
  GeometryDescription,
  ShapeDescription,
  TextureDescription,
  TextureRole,
} from "../document/description.ts";
import type { SceneElement } from "../document/element.ts";
import type { PreviewedShape } from "../preview/previewMeshes.ts";
import { lateEnvironment } from "../render/environment/lateEnvironment.ts";
import type { SceneRenderer } from "../render/sceneRenderer.ts";
import type { SceneChanges } from "../render/shapes/shapeChanges.ts";
import type { Stage, StageName } from "../stage/stage.ts";
import { stageNames } from "../stage/stage.ts";
import type { DisplayedFrame } from "../viewer/displayedFrames.ts";
import type { StageChange } from "../viewer/geometryExchange.ts";
import { LoadingShape } from "../viewer/loadingShape.ts";
import { LoadingShapes } from "../viewer/loadingShapes.ts";
import { reachesStage, lowestStageOf, LoadingEvents } from "./loadingEvents.ts";

export interface PageShapesListener {
  /** A patch displays another stage. */
  onStage(stage: Stage | undefined): void;
  onError(error: DeliveryError, element: Element, loading: LoadingEvents): void;
  /** Whether a shape may complete when no file of it is being loaded. */
  maySettle(): boolean;
}

/** Receives what a shape loads. */
interface PageShapeListener extends Pick<PageShapesListener, "onError"> {
  onStage(shape: PageShape, change: StageChange): void;
  onLiveFrame(shape: PageShape, frame: DisplayedFrame): void;
  onTextureImage(shape: PageShape, role: TextureRole | CubeMapRole, image: TextureImage | undefined): void;
  onSettled(shape: PageShape): void;
  onGeometryReplaced(): void;
  onReplacing(shape: PageShape, isReplacing: boolean): void;
  onSwap(): void;
  onRemoved(shape: PageShape): void;
}

export class PageShape extends LoadingShape {
  #loading: LoadingEvents;
  #stages: (StageName | "none")[];
  readonly #listener: PageShapeListener;

  /** `previewStage`: what the preview displays of the shape. */
  constructor(
    deliveries: SceneDeliveries,
    described: ShapeDescription,
    previewStage: StageName | "none",
    listener: PageShapeListener,
  ) {
    super(deliveries, described);
    this.#listener = listener;
    this.#stages = noStages(described.geometry);
    this.#loading = new LoadingEvents(described.element as Element, () => this.transfers, previewStage);
    if (described.geometry === undefined) this.#loading.settle();
  }

  get loading(): LoadingEvents {
    return this.#loading;
  }

  /** The stage that each patch of the described geometry displays. */
  get stages(): (StageName | "none")[] {
    return this.#stages;
  }

  override onStage(change: StageChange): void {
    this.#listener.onStage(this, change);
  }

  override onFrame(frame: DisplayedFrame): void {
    this.#listener.onLiveFrame(this, frame);
  }

  override onGeometryReplaced(): void {
    this.#listener.onGeometryReplaced();
    if (this.geometry?.moving) {
      // It begins to move: what it has loaded is in the document, and its events go on.
      this.#stages = noStages(this.geometry);
      return;
    }
    const { waitingFrame } = this.#loading;
    this.#loading.abandon();
    this.#stages = noStages(this.geometry);
    this.#loading = new LoadingEvents(this.element as Element, () => this.transfers);
    if (waitingFrame !== undefined) this.#loading.displayFrame(waitingFrame);
    if (this.geometry === undefined) this.#loading.settle();
  }

  override onReplacing(isReplacing: boolean): void {
    this.#listener.onReplacing(this, isReplacing);
  }

  override onSwap(): void {
    this.#listener.onSwap();
  }

  protected override picturesOf({
    textures,
    cubeMap,
  }: AppearanceDescription): readonly (TextureDescription | CubeMapPicture)[] {
    return [...textures, ...(cubeMap?.pictures ?? [])];
  }

  override onTextureImage(role: TextureRole | CubeMapRole, image: TextureImage | undefined): void {
    const problem = image && lateEnvironment.added?.cubeMapProblemOf(role, image.image);
    if (problem !== undefined) this.onError(new DeliveryError("unsupported", this.urlOf(role), problem));
    this.#listener.onTextureImage(this, role, image);
  }

  override onError(error: DeliveryError): void {
    this.#listener.onError(error, this.element as Element, this.loading);
  }

  override onSettled(): void {
    this.#listener.onSettled(this);
  }

  override onRemoved(): void {
    this.loading.abandon();
    this.#listener.onRemoved(this);
  }
}

function noStages(geometry: GeometryDescription | undefined): "none"[] {
  return geometry?.patches.map(() => "none" as const) ?? [];
}

export class PageShapes extends LoadingShapes<PageShape> {
  readonly #renderer: SceneRenderer;
  readonly #deliveries: SceneDeliveries;
  readonly #listener: PageShapesListener;
  /**
   * Visible shapes that are not complete. A set, so that a shape of ten thousand can tell in constant time whether it
   * is the last to complete.
   */
  readonly #incomplete = new Set<PageShape>();
  /** Shapes that display a geometry in place of the described one. */
  readonly #replacing = new Set<PageShape>();
  /** What the preview displays of shapes that have not begun to load. */
  readonly #previewed: Map<SceneElement, StageName>;
  /**
   * Whether every visible shape has sent its last event. Stored, so that a frame does not visit each of ten thousand
   * shapes.
   */
  #isQuiet = false;

  constructor(
    renderer: SceneRenderer,
    deliveries: SceneDeliveries,
    listener: PageShapesListener,
    previewed: readonly PreviewedShape[],
  ) {
    super();
    this.#renderer = renderer;
    this.#deliveries = deliveries;
    this.#listener = listener;
    this.#previewed = new Map(previewed.map(({ element, stage }) => [element, stage]));
  }

  override follow(changes: SceneChanges): () => void {
    for (const [element, { visible, geometry }] of changes.shapes) {
      const shape = this.get(element);
      if (shape?.isVisible !== visible || shape.geometry !== geometry) this.#isQuiet = false;
    }
    const leave = super.follow(changes);
    for (const element of changes.shapes.keys()) {
      const shape = this.get(element);
      if (shape === undefined) continue;
      if (shape.isVisible && !shape.loading.isSettled) this.#incomplete.add(shape);
      else this.#incomplete.delete(shape);
    }
    return leave;
  }

  /** Whether no visible shape has an event to send. */
  get isQuiet(): boolean {
    return this.#isQuiet;
  }

  /** Whether a visible shape is not complete. */
  get isLoading(): boolean {
    return this.#incomplete.size > 0;
  }

  /**
   * Whether each patch that a preview displays is displayed here in at least the same stage. Also true for a shape that
   * is hidden, complete or gone.
   */
  displays({ element, patches, stage }: PreviewedShape): boolean {
    const shape = this.get(element);
    return (
      shape === undefined ||
      !shape.isVisible ||
      shape.loading.isSettled ||
      patches.every((patch) => reachesStage(shape.stages[patch] ?? "none", stage))
    );
  }

  /** Whether a patch is displayed here that a preview does not display, or displays in an earlier stage. */
  refines({ element, patches, stage: previewed }: PreviewedShape): boolean {
    const stages = this.get(element)?.stages ?? [];
    return stages.some(
      (stage, patch) => stage !== "none" && !(patches.includes(patch) && reachesStage(previewed, stage)),
    );
  }

  /** Number of patches whose files workers decode on every GPU. */
  get workerJobCount(): number {
    let count = 0;
    for (const { geometry, isVisible } of this) {
      if (isVisible && geometry !== undefined && needsWorkers(geometry)) count += geometry.patches.length;
    }
    return count;
  }

  /** Whether files of compact are requested. */
  get hasCompact(): boolean {
    return Array.from(this).some(({ geometry, isVisible }) => isVisible && geometry?.encoding === "compact");
  }

  /** The loading of each visible shape: files of hidden shapes are fetched when they become visible. */
  get visibleLoadings(): readonly LoadingEvents[] {
    return Array.from(this)
      .filter(({ isVisible }) => isVisible)
      .map(({ loading }) => loading);
  }

  /** Completes visible shapes of which this view requests nothing more, even if they could be refined. */
  settle(): void {
    for (const shape of this) {
      shape.displayWhole();
      this.#settle(shape);
    }
  }

  updateProgress(): void {
    for (const shape of this) {
      const { loading } = shape;
      if (shape.isJoined && shape.isVisible && !loading.isEnded)
        loading.updateProgress(progressOf(shape.transfers, loading.progress));
    }
  }

  /** Sends the events that wait for a frame. */
  onFrame(): void {
    this.#isQuiet = true;
    for (const { loading, isVisible } of this) {
      loading.onFrame(false);
      this.#isQuiet &&= loading.isEnded || !isVisible;
    }
  }

  /**
   * Removes what shapes display and leaves their deliveries, until `join`. Events that have been sent are not sent
   * again.
   */
  override suspend(): void {
    for (const { element, stages } of this) {
      this.#renderer.scene.clearShape(element);
      stages.fill("none");
    }
    super.suspend();
  }

  override dispose(): void {
    super.dispose();
    this.#incomplete.clear();
  }

  protected override get isSuspended(): boolean {
    return this.#renderer.isContextLost;
  }

  protected override makeShape(described: ShapeDescription): PageShape {
    this.#isQuiet = false;
    const { element: previewedElement } = described;
    const previewStage = this.#previewed.get(previewedElement) ?? "none";
    this.#previewed.delete(previewedElement);
    return new PageShape(this.#deliveries, described, previewStage, {
      onStage: (shape, change) => {
        this.#onStage(shape, change);
      },
      onLiveFrame: ({ loading }, frame) => {
        loading.displayFrame(frame);
        this.#isQuiet = false;
      },
      onTextureImage: ({ element }, role, image) => {
        this.#renderer.scene.setTextureImage(element, role, image);
      },
      onError: (error, element, loading) => {
        this.#listener.onError(error, element, loading);
      },
      onSettled: (shape) => {
        this.#settle(shape);
      },
      onGeometryReplaced: () => {
        this.#renderer.uploads.expectReplacements();
      },
      onReplacing: (shape, isReplacing) => {
        if (isReplacing) this.#replacing.add(shape);
        else this.#replacing.delete(shape);
        this.#renderer.uploads.isReplacing = this.#replacing.size > 0;
      },
      onSwap: () => {
        this.#renderer.uploads.expectReplacements();
      },
      onRemoved: (shape) => {
        this.#incomplete.delete(shape);
      },
    });
  }

  #onStage(shape: PageShape, { geometry, patch, stage, drawn }: StageChange): void {
    const { element, stages, loading } = shape;
    this.#renderer.scene.setStage(element, drawn, patch, stage);
    this.#listener.onStage(stage);
    if (geometry !== shape.geometry) return;
    stages[patch] = stage?.name ?? "none";
    loading.reach(displayedStageOf(stages));
    this.#isQuiet = false;
  }

  #settle(shape: PageShape): void {
    const { loading, isVisible } = shape;
    if (loading.isSettled || !isVisible || !this.#listener.maySettle() || !shape.isSettled) return;
    loading.settle();
    this.#incomplete.delete(shape);
    this.#isQuiet = false;
    // Events wait for a frame. The frame of the last event does not wait until the GPU is idle.
    if (this.isLoading) this.#renderer.frames.requestPaced();
    else this.#renderer.frames.request();
  }
}

/**
 * The stage of a shape by its patches' stages, or of a scene by its shapes': the lowest of them, but `points` if only
 * some are "none".
 */
export function displayedStageOf(stages: readonly (StageName | "none")[]): StageName | "none" {
  const lowest = lowestStageOf(stages);
  return lowest === "none" && stages.some((stage) => stage !== "none") ? (stageNames[0] ?? "none") : lowest;
}
