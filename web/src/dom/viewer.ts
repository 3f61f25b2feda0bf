// Joins a document to a picture: reads the scene, starts and ends deliveries as
// shapes come and go, hands stages to the renderer, and tells the page.

import { decodeWithBrowser } from "../decode/image.ts";
import type { StageName } from "../decode/stage.ts";
import { stageNames } from "../decode/stage.ts";
import type { Delivery } from "../delivery/deliver.ts";
import type { DeliveryError } from "../delivery/deliveryError.ts";
import { progressOf } from "../delivery/progress.ts";
import { ResourcePool } from "../delivery/resources.ts";
import { SharedDeliveries } from "../delivery/sharedDeliveries.ts";
import type { GeometryDescription, SceneDescription, ShapeDescription } from "../document/description.ts";
import { shapesOf } from "../document/description.ts";
import type { SceneElement } from "../document/element.ts";
import { GeometryMemory } from "../document/geometryMemory.ts";
import { readScene } from "../document/readScene.ts";
import type { RenderStatistics } from "../render/sceneRenderer.ts";
import { SceneRenderer } from "../render/sceneRenderer.ts";
import { defaultDownloadOptions } from "../scheduler/download.ts";
import { Scheduler } from "../scheduler/scheduler.ts";
import { leastStage, Loading } from "./loading.ts";

/** Downloads at a time: few, so that what matters most gets the whole line (paper section 5.4). */
const slotCount = 6;

export interface ViewStatistics extends RenderStatistics {
  /** Requests ever sent, retries included. */
  readonly requests: number;
  readonly openRequests: number;
}

interface LoadedShape {
  readonly geometry: GeometryDescription | undefined;
  readonly loading: Loading;
  readonly stages: (StageName | "none")[];
  delivery: Delivery | undefined;
}

export class Viewer {
  readonly renderer: SceneRenderer;
  readonly #x3d: Element;
  readonly #scheduler = new Scheduler(slotCount);
  readonly #pool: ResourcePool;
  readonly #deliveries: SharedDeliveries;
  readonly #geometries = new GeometryMemory();
  readonly #shapes = new Map<SceneElement, LoadedShape>();
  readonly #observer: MutationObserver;
  readonly #onProgress: (share: number) => void;
  readonly #warned = new Set<string>();
  #loading: Loading;
  #progressIsDue = false;

  constructor(x3d: Element, canvas: HTMLCanvasElement, context: WebGL2RenderingContext, onProgress: (share: number) => void) {
    this.#x3d = x3d;
    this.#onProgress = onProgress;
    this.#loading = new Loading(x3d);
    this.renderer = new SceneRenderer(canvas, context, () => { this.#onFrame(); });
    this.#pool = new ResourcePool({
      scheduler: this.#scheduler,
      decodeImage: decodeWithBrowser,
      download: defaultDownloadOptions,
      // What is no URL is left for the request to fail on.
      resolve: (url) => (URL.canParse(url, document.baseURI) ? new URL(url, document.baseURI).href : url),
      onTransfer: () => { this.#progressSoon(); },
    });
    this.#deliveries = new SharedDeliveries(this.#pool);
    this.#observer = new MutationObserver((records) => {
      for (const { target } of records) this.#touchAround(target);
      this.#readDocument();
    });
    this.#observer.observe(x3d, { subtree: true, childList: true, attributes: true });
    this.#readDocument();
  }

  get statistics(): ViewStatistics {
    const { started, running, waiting } = this.#scheduler;
    return { ...this.renderer.statistics, requests: started, openRequests: running + waiting };
  }

  /** Aborts all requests and frees the GPU. */
  dispose(): void {
    this.#observer.disconnect();
    for (const shape of this.#shapes.values()) {
      shape.delivery?.cancel();
      shape.loading.abandon();
    }
    this.#shapes.clear();
    this.#loading.abandon();
    this.renderer.dispose();
  }

  #readDocument(): void {
    const scene = readScene(this.#x3d, this.#geometries);
    this.#warn(scene);
    const described = new Map(shapesOf(scene.root).map((shape) => [shape.element, shape]));
    const isShown = (shape: ShapeDescription | undefined) => {
      const loaded = shape && this.#shapes.get(shape.element);
      return loaded !== undefined && loaded.geometry === shape?.geometry;
    };
    const gone = Array.from(this.#shapes).filter(([element]) => !isShown(described.get(element)));
    const begun = Array.from(described.values()).filter((shape) => !isShown(shape));

    // The renderer lets go of textures before the pool closes their images.
    for (const [element, shape] of gone) {
      this.renderer.clearShape(element);
      this.#shapes.delete(element);
      shape.loading.abandon();
    }
    if (begun.length > 0 && this.#loading.isEnded) this.#loading = new Loading(this.#x3d);
    this.renderer.setScene(scene);
    for (const shape of begun) this.#begin(shape);
    // Last, so that files that old and new shapes share are not fetched again.
    for (const [, shape] of gone) shape.delivery?.cancel();
    this.#progressSoon();
  }

  /** The geometry that this is, or is a part of, may have changed. */
  #touchAround(changed: Node): void {
    for (let node: Node | null = changed; node !== null && node !== this.#x3d; node = node.parentNode) {
      this.#geometries.touch(node as Element);
    }
  }

  #begin(shape: ShapeDescription): void {
    const element = shape.element as Element;
    const { geometry } = shape;
    const loaded: LoadedShape = {
      geometry, loading: new Loading(element), delivery: undefined, stages: geometry?.patches.map(() => "none" as const) ?? [],
    };
    this.#shapes.set(element, loaded);
    if (geometry === undefined) {
      loaded.loading.settle();
      return;
    }
    loaded.delivery = this.#deliveries.join(geometry, {
      onStage: (patch, stage) => {
        this.renderer.setStage(element, geometry, patch, stage);
        loaded.stages[patch] = stage.name;
        this.#reach(loaded, geometry);
      },
      onError: (error) => { this.#fail(loaded, element, error); },
      onSettled: () => {
        loaded.loading.settle();
        this.renderer.requestFrame(); // events wait for a frame
      },
    });
  }

  /** A shape is as far as its last patch; with a first picture as soon as any patch shows. */
  #reach(shape: LoadedShape, geometry: GeometryDescription): void {
    shape.loading.reach(stageShown(shape.stages.slice(0, geometry.patches.length)));
    // Shapes of which nothing will come do not hold the scene back.
    this.#loading.reach(stageShown(Array.from(this.#shapes.values(), ({ loading }) => loading)
      .filter(({ stage, isSettled }) => stage !== "none" || !isSettled).map(({ stage }) => stage)));
  }

  #fail(shape: LoadedShape, element: Element, error: DeliveryError): void {
    console.error(`imgeo: ${error.message}`);
    const detail = { type: error.kind, url: error.url, element, message: error.message };
    shape.loading.fail(detail, error);
    this.#loading.fail(detail, error);
  }

  /** Once a turn of the event loop is often enough to tell of bytes. */
  #progressSoon(): void {
    if (this.#progressIsDue) return;
    this.#progressIsDue = true;
    setTimeout(() => { this.#tellProgress(); });
  }

  #tellProgress(): void {
    this.#progressIsDue = false;
    for (const { loading, delivery } of this.#shapes.values()) {
      if (delivery && !loading.isEnded) loading.moveOn(progressOf(delivery.transfers, loading.progress));
    }
    if (!this.#loading.isEnded) this.#loading.moveOn(progressOf(this.#pool.transfers(), this.#loading.progress));
    this.#onProgress(this.#loading.progress.totalProgress);
  }

  #onFrame(): void {
    this.#tellProgress(); // all of it before `load`
    const loadings = Array.from(this.#shapes.values(), ({ loading }) => loading);
    // Asked for only now: until a frame has shown the end, further shapes may join.
    if (loadings.every((loading) => loading.isSettled)) this.#loading.settle();
    for (const loading of loadings) loading.onFrame(false);
    this.#loading.onFrame(true);
  }

  /** One line for each thing in the document that could not be taken as written. */
  #warn(scene: SceneDescription): void {
    for (const { element, message } of scene.warnings) {
      const line = `imgeo: <${element.localName}> ${message}`;
      if (this.#warned.has(line)) continue;
      this.#warned.add(line);
      console.warn(line);
    }
  }
}

function stageShown(stages: readonly (StageName | "none")[]): StageName | "none" {
  const least = leastStage(stages);
  return least === "none" && stages.some((stage) => stage !== "none") ? (stageNames[0] ?? "none") : least;
}
