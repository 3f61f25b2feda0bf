// Steers deliveries by what the camera sees: says which files each geometry
// needs, and how soon, when the scene or the view has changed.

import type { ViewState } from "../delivery/filePriority.ts";
import { filePriorityFor, texturePriorityFor } from "../delivery/filePriority.ts";
import type { SceneDeliveries } from "../delivery/requestWithinBudget.ts";
import { requestWithinBudget, storedBytesOf } from "../delivery/requestWithinBudget.ts";
import type { SceneRenderer } from "../render/sceneRenderer.ts";
import type { SceneChanges } from "../render/shapes/shapeChanges.ts";
import type { View } from "../render/view.ts";
import type { ChunkWeights } from "../scheduler/priority.ts";
import { chunkWeightsOf, defaultChunkWeights } from "../scheduler/priority.ts";
import { planesOf } from "../scheduler/viewMetrics.ts";
import { VisibleInstances } from "./visibleInstances.ts";

/** While the camera moves, the order changes this often; a few files' time on a fast line. */
const steeringIntervalMs = 100;

export class DeliveryControl {
  readonly #renderer: SceneRenderer;
  readonly #deliveries: SceneDeliveries;
  readonly #onSteered: () => void;
  readonly #places = new VisibleInstances();
  #chunkPriority = "";
  #weights: ChunkWeights = defaultChunkWeights;
  #view: View | undefined;
  #mostBytes = Infinity;
  /** What all deliveries were known to take when they were last steered. */
  #knownBytes = 0;
  #timer: ReturnType<typeof setTimeout> | undefined;
  #isHeld = true;

  /** `onSteered` is called when files may have been added to those that are wanted, or taken from them. */
  constructor(renderer: SceneRenderer, deliveries: SceneDeliveries, onSteered: () => void) {
    this.#renderer = renderer;
    this.#deliveries = deliveries;
    this.#onSteered = onSteered;
  }

  /** Steers by what the scene is now, its bound viewpoint too; `onProblem` is told what cannot be read of its weights. */
  follow(chunkPriority: string, { instances: places }: SceneChanges, onProblem: (problem: string) => void): void {
    if (places.size === 0 && chunkPriority === this.#chunkPriority && isSameView(this.#renderer.view, this.#view))
      return;
    if (chunkPriority !== this.#chunkPriority) this.#weights = chunkWeightsOf(chunkPriority, onProblem);
    this.#chunkPriority = chunkPriority;
    this.#places.follow(places);
    this.request();
  }

  /** Bytes on the GPU that deliveries may take. */
  setBudget(mostBytes: number): void {
    if (mostBytes === this.#mostBytes) return;
    this.#mostBytes = mostBytes;
    this.request();
  }

  /** Asks for nothing before this. */
  start(): void {
    this.#isHeld = false;
    this.request();
  }

  /** Soon, if since the last time the camera has moved, or more has come than may. */
  followCamera(): void {
    if (this.#timer !== undefined) return;
    const storedBytes = storedBytesOf(this.#deliveries);
    const isOverBudget = storedBytes > this.#mostBytes && storedBytes !== this.#knownBytes;
    if (!isOverBudget && isSameView(this.#renderer.view, this.#view)) return;
    this.#timer = setTimeout(() => {
      this.request();
    }, steeringIntervalMs);
  }

  /** Now. */
  request(): void {
    this.stop();
    if (this.#isHeld) return;
    this.#view = this.#renderer.view;
    const viewing = viewingOf(this.#view, this.#weights);
    requestWithinBudget(
      this.#deliveries,
      (geometry) => filePriorityFor(this.#places.ofGeometry(geometry), viewing),
      (key, chunk) => texturePriorityFor(this.#places.ofPicture(key), chunk, viewing),
      this.#mostBytes,
    );
    this.#knownBytes = storedBytesOf(this.#deliveries);
    this.#onSteered();
  }

  stop(): void {
    clearTimeout(this.#timer);
    this.#timer = undefined;
  }
}

function viewingOf(view: View | undefined, weights: ChunkWeights): ViewState {
  return { weights, camera: view && { ...view, planes: planesOf(view.clipFromScene) } };
}

function isSameView(a: View | undefined, b: View | undefined): boolean {
  if (a === undefined || b === undefined) return a === b;
  return (
    a.pixelsPerUnit === b.pixelsPerUnit && a.clipFromScene.every((value, place) => value === b.clipFromScene[place])
  );
}
