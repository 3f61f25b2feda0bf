// Controls the deliveries of a scene: whenever the scene or the view has changed, requests
// the files of geometries and textures, ordered by what the camera sees and within a budget
// of GPU memory.

import type { ViewState } from "../delivery/filePriority.ts";
import { filePriorityFor, texturePriorityFor } from "../delivery/filePriority.ts";
import type { LevelDemand } from "../delivery/geometryView.ts";
import type { SceneView } from "../levels/levelViews.ts";
import type { SceneDeliveries } from "../delivery/requestWithinBudget.ts";
import { requestWithinBudget, storedBytesOf } from "../delivery/requestWithinBudget.ts";
import type { SceneChanges } from "../render/shapes/shapeChanges.ts";
import { shapeInstanceOf } from "../render/shapes/shapeChanges.ts";
import type { NodeInstance } from "../scene/nodeInstance.ts";
import type { View } from "../render/view.ts";
import type { ChunkWeights } from "../scheduler/priority.ts";
import { chunkWeightsOf, defaultChunkWeights } from "../scheduler/priority.ts";
import type { Point } from "../scheduler/viewMetrics.ts";
import { planesOf } from "../scheduler/viewMetrics.ts";
import { VisibleInstances } from "./visibleInstances.ts";

/** Time between two orders of requests while the camera moves. In this time a fast connection fetches a few files. */
const cameraIntervalMs = 100;

export interface DeliveryControlOptions {
  readonly deliveries: SceneDeliveries;
  /** The view of the camera; undefined if there is no single camera: files of all visible shapes are then requested. */
  readonly view: () => View | undefined;
  /** What levels of detail are refined for. Default: `view`, and the budget of all. */
  readonly levelDemand?: () => LevelDemand;
  /** Keys (textureKeyOf) of textures that are not those of shapes and that fill the view. */
  readonly sceneTextures: () => ReadonlySet<string>;
  /** The instances of shapes that have moved since the last call. */
  readonly takeMoved: () => readonly NodeInstance[];
  /** The set of requested files may have changed. */
  readonly onRequests: () => void;
}

export class DeliveryControl {
  readonly #options: DeliveryControlOptions;
  readonly #instances = new VisibleInstances();
  #chunkPriority = "";
  #weights: ChunkWeights = defaultChunkWeights;
  /** The view of the last requests. */
  #view: View | undefined;
  #maxBytes = Infinity;
  #focus: Point | undefined;
  /** GPU memory of all deliveries at the last requests. */
  #storedBytes = 0;
  #timer: ReturnType<typeof setTimeout> | undefined;
  #isStarted = false;
  /**
   * How many deliveries had been started when everything had loaded, within the budget. Until the next request, or
   * until another delivery starts, no view and no move needs one: a scene that moves asks no delivery.
   */
  #restCount: number | undefined;

  constructor(options: DeliveryControlOptions) {
    this.#options = options;
  }

  /**
   * Requests what a changed scene needs, or a changed view of its bound viewpoint. `onProblem` gets a sentence for each
   * part of `chunkPriority` that cannot be read.
   */
  follow(chunkPriority: string, { instances }: SceneChanges, onProblem: (problem: string) => void): void {
    const isSame = instances.size === 0 && chunkPriority === this.#chunkPriority;
    if (isSame && isSameView(this.#options.view(), this.#view)) return;
    if (chunkPriority !== this.#chunkPriority) this.#weights = chunkWeightsOf(chunkPriority, onProblem);
    this.#chunkPriority = chunkPriority;
    this.#followMoved();
    this.#instances.follow(instances);
    this.request();
  }

  /** Schedules requests for shapes that have moved; not in each frame, as some may move all the time. */
  followMoves(): void {
    this.#requestSoon();
  }

  /** Sets the GPU memory that deliveries may take. */
  setBudget(maxBytes: number): void {
    if (maxBytes === this.#maxBytes) return;
    this.#maxBytes = maxBytes;
    this.request();
  }

  /** Refines levels of detail around a point of the scene first; undefined: by the view alone. */
  setFocus(focus: Point | undefined): void {
    this.#focus = focus;
    this.request();
  }

  /** Begins to request files. */
  start(): void {
    this.#isStarted = true;
    this.request();
  }

  /**
   * Schedules new requests if, since the last requests, the camera has moved or the deliveries have grown beyond the
   * budget.
   */
  followCamera(): void {
    if (this.#timer !== undefined || this.#isAtRest) return;
    const storedBytes = storedBytesOf(this.#options.deliveries);
    const isOverBudget = storedBytes > this.#maxBytes && storedBytes !== this.#storedBytes;
    if (isOverBudget || !isSameView(this.#options.view(), this.#view)) this.#requestSoon();
  }

  #requestSoon(): void {
    if (this.#isAtRest) return;
    this.#timer ??= setTimeout(() => {
      this.#timer = undefined;
      if (this.#followsView) this.request();
      else this.#restCount = this.#startedCount;
    }, cameraIntervalMs);
  }

  /** Requests what the view needs, at once; without effect before `start`. */
  request(): void {
    this.#cancelTimer();
    this.#restCount = undefined;
    if (!this.#isStarted) return;
    const { deliveries, view, sceneTextures, onRequests } = this.#options;
    this.#followMoved();
    this.#view = view();
    const viewState = viewStateOf(this.#view, this.#weights);
    const { views, maxBytes } = this.#options.levelDemand?.() ?? {
      views: sceneViewsOf(this.#view, viewState),
      maxBytes: this.#maxBytes,
    };
    requestWithinBudget(
      deliveries,
      (geometry) => filePriorityFor(this.#instances.ofGeometry(geometry), viewState),
      (key, chunk) => texturePriorityFor(this.#instances.ofTexture(key), chunk, viewState, sceneTextures().has(key)),
      this.#maxBytes,
      {
        viewOf: (geometry) => ({ views, instances: this.#instances.ofGeometry(geometry), focus: this.#focus }),
        maxBytes,
      },
    );
    this.#storedBytes = storedBytesOf(deliveries);
    onRequests();
  }

  /** Aborts all requests, and makes no more. What has loaded stays. */
  stop(): void {
    this.#cancelTimer();
    this.#isStarted = false;
    const noPriority = () => undefined;
    requestWithinBudget(this.#options.deliveries, () => noPriority, noPriority);
  }

  get #startedCount(): number {
    const { geometries, textures } = this.#options.deliveries;
    return geometries.startedCount + textures.startedCount;
  }

  get #isAtRest(): boolean {
    return this.#restCount === this.#startedCount;
  }

  /** Whether another view may request files, or let others leave. */
  get #followsView(): boolean {
    const { deliveries } = this.#options;
    const { geometries, textures } = deliveries;
    return geometries.followView || !textures.areExhausted || storedBytesOf(deliveries) > this.#maxBytes;
  }

  #followMoved(): void {
    this.#instances.follow(this.#options.takeMoved().map((node) => [node, shapeInstanceOf(node)] as const));
  }

  #cancelTimer(): void {
    clearTimeout(this.#timer);
    this.#timer = undefined;
  }
}

function viewStateOf(view: View | undefined, weights: ChunkWeights): ViewState {
  return { weights, camera: view && { ...view, planes: planesOf(view.clipFromScene) } };
}

function sceneViewsOf(view: View | undefined, { camera }: ViewState): readonly SceneView[] {
  return view && camera ? [{ camera, isOrthographic: isOrthographic(view) }] : [];
}

/** Whether depths do not change w. */
function isOrthographic({ clipFromScene: m }: View): boolean {
  return m[3] === 0 && m[7] === 0 && m[11] === 0;
}

function isSameView(a: View | undefined, b: View | undefined): boolean {
  if (a === undefined || b === undefined) return a === b;
  return (
    a.pixelsPerUnit === b.pixelsPerUnit && a.clipFromScene.every((value, index) => value === b.clipFromScene[index])
  );
}
