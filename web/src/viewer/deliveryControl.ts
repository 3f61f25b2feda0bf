// Controls the deliveries of a scene: requests files of geometries and textures, in
// the order of what the camera sees and within a budget of GPU memory, whenever the
// scene or the view has changed.

import type { ViewState } from "../delivery/filePriority.ts";
import { filePriorityFor, texturePriorityFor } from "../delivery/filePriority.ts";
import type { SceneDeliveries } from "../delivery/requestWithinBudget.ts";
import { requestWithinBudget, storedBytesOf } from "../delivery/requestWithinBudget.ts";
import type { SceneChanges } from "../render/shapes/shapeChanges.ts";
import type { View } from "../render/view.ts";
import type { ChunkWeights } from "../scheduler/priority.ts";
import { chunkWeightsOf, defaultChunkWeights } from "../scheduler/priority.ts";
import { planesOf } from "../scheduler/viewMetrics.ts";
import { VisibleInstances } from "./visibleInstances.ts";

/** While the camera moves, requests are ordered anew this often; a fast connection takes as long for a few files. */
const cameraIntervalMs = 100;

export interface DeliveryControlOptions {
  readonly deliveries: SceneDeliveries;
  /** What the camera sees; undefined where that is not known: all that is visible is then requested. */
  readonly view: () => View | undefined;
  /** Files may have been added to those that are requested, or taken from them. */
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
  /** GPU memory of all deliveries, as far as was known at the last requests. */
  #storedBytes = 0;
  #timer: ReturnType<typeof setTimeout> | undefined;
  #isStarted = false;

  constructor(options: DeliveryControlOptions) {
    this.#options = options;
  }

  /** Follows a changed scene, its bound viewpoint too; `onProblem` gets a sentence for what `chunkPriority` has that cannot be read. */
  follow(chunkPriority: string, { instances }: SceneChanges, onProblem: (problem: string) => void): void {
    const isSame = instances.size === 0 && chunkPriority === this.#chunkPriority;
    if (isSame && isSameView(this.#options.view(), this.#view)) return;
    if (chunkPriority !== this.#chunkPriority) this.#weights = chunkWeightsOf(chunkPriority, onProblem);
    this.#chunkPriority = chunkPriority;
    this.#instances.follow(instances);
    this.request();
  }

  /** Sets the GPU memory that deliveries may take. */
  setBudget(maxBytes: number): void {
    if (maxBytes === this.#maxBytes) return;
    this.#maxBytes = maxBytes;
    this.request();
  }

  /** Begins to request files. */
  start(): void {
    this.#isStarted = true;
    this.request();
  }

  /** Requests soon where, since the last requests, the camera has moved or deliveries have come to exceed the budget. */
  followCamera(): void {
    if (this.#timer !== undefined) return;
    const storedBytes = storedBytesOf(this.#options.deliveries);
    const isOverBudget = storedBytes > this.#maxBytes && storedBytes !== this.#storedBytes;
    if (!isOverBudget && isSameView(this.#options.view(), this.#view)) return;
    this.#timer = setTimeout(() => {
      this.request();
    }, cameraIntervalMs);
  }

  /** Requests now what the view needs, unless control has not been started. */
  request(): void {
    this.#cancelTimer();
    if (!this.#isStarted) return;
    const { deliveries, view, onRequests } = this.#options;
    this.#view = view();
    const viewState = viewStateOf(this.#view, this.#weights);
    requestWithinBudget(
      deliveries,
      (geometry) => filePriorityFor(this.#instances.ofGeometry(geometry), viewState),
      (key, chunk) => texturePriorityFor(this.#instances.ofTexture(key), chunk, viewState),
      this.#maxBytes,
    );
    this.#storedBytes = storedBytesOf(deliveries);
    onRequests();
  }

  /** Gives up all requests, and makes no more. What has come stays. */
  stop(): void {
    this.#cancelTimer();
    this.#isStarted = false;
    const nothing = () => undefined;
    requestWithinBudget(this.#options.deliveries, () => nothing, nothing);
  }

  #cancelTimer(): void {
    clearTimeout(this.#timer);
    this.#timer = undefined;
  }
}

function viewStateOf(view: View | undefined, weights: ChunkWeights): ViewState {
  return { weights, camera: view && { ...view, planes: planesOf(view.clipFromScene) } };
}

function isSameView(a: View | undefined, b: View | undefined): boolean {
  if (a === undefined || b === undefined) return a === b;
  return (
    a.pixelsPerUnit === b.pixelsPerUnit && a.clipFromScene.every((value, index) => value === b.clipFromScene[index])
  );
}
