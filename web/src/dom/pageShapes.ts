// The loading of a scene's shapes: what each has asked for, what of it is on the
// screen, and what its element says of that.

import type { Stage, StageName } from "../stage/stage.ts";
import { stageNames } from "../stage/stage.ts";
import type { DeliveryError } from "../delivery/deliveryError.ts";
import type { Transfer } from "../delivery/progress.ts";
import { progressOf } from "../delivery/progress.ts";
import type { JoinedDelivery, GeometryDeliveries } from "../delivery/geometryDeliveries.ts";
import { ShapeTextures } from "../delivery/shapeTextures.ts";
import type { TextureDeliveries } from "../delivery/textureDeliveries.ts";
import type { GeometryDescription, ShapeDescription, TextureDescription } from "../document/description.ts";
import type { SceneElement } from "../document/element.ts";
import type { SceneRenderer } from "../render/sceneRenderer.ts";
import type { SceneChanges } from "../render/shapes/shapeChanges.ts";
import { lowestStageOf, LoadingEvents } from "./loadingEvents.ts";

interface LoadedShape {
  readonly geometry: GeometryDescription | undefined;
  /** In any of its places. */
  isVisible: boolean;
  readonly loading: LoadingEvents;
  readonly stages: (StageName | "none")[];
  delivery: JoinedDelivery | undefined;
  /** What is laid over it, and what is to be. */
  readonly textures: ShapeTextures;
  described: readonly TextureDescription[];
}

export interface PageShapesListener {
  /** A patch shows another stage. */
  onStage(stage: Stage | undefined): void;
  onError(error: DeliveryError, element: Element, loading: LoadingEvents): void;
  /** Whether shapes of which nothing is on its way may be complete. */
  maySettle(): boolean;
}

/** Ends what was begun for shapes that are gone. */
export type Leave = () => void;

export class PageShapes {
  readonly #renderer: SceneRenderer;
  readonly #deliveries: GeometryDeliveries;
  readonly #textures: TextureDeliveries;
  readonly #listener: PageShapesListener;
  readonly #shapes = new Map<SceneElement, LoadedShape>();
  /** Those that are seen and not complete. Kept, since each of ten thousand that is complete asks whether it is the last. */
  readonly #coming = new Set<LoadedShape>();
  /** Those that were on the screen before they were here. */
  readonly #shownBefore: Set<SceneElement>;
  /** Those that are here and have said all: of ten thousand no frame asks once more. */
  #isQuiet = false;

  constructor(
    renderer: SceneRenderer,
    deliveries: GeometryDeliveries,
    textures: TextureDeliveries,
    listener: PageShapesListener,
    shownBefore: Iterable<SceneElement>,
  ) {
    this.#renderer = renderer;
    this.#deliveries = deliveries;
    this.#textures = textures;
    this.#listener = listener;
    this.#shownBefore = new Set(shownBefore);
  }

  /** Its geometry is what its element shows already. */
  has({ element, geometry }: ShapeDescription): boolean {
    const loaded = this.#shapes.get(element);
    return loaded !== undefined && loaded.geometry === geometry;
  }

  /**
   * Follows shapes of the scene as they change. The files that only those that are gone
   * have asked for are given up when what comes back is called: after those of new
   * shapes are asked for.
   */
  follow({ shapes, removed: gone }: SceneChanges): Leave {
    const ended: LoadedShape[] = [];
    for (const element of gone) this.#end(element, ended);
    for (const [element, shape] of shapes) {
      if (!this.has(shape)) this.#end(element, ended);
      const loaded = this.#shapes.get(element) ?? this.#begin(shape);
      loaded.described = shape.appearance.textures;
      if (!this.#renderer.isContextLost) loaded.textures.follow(loaded.described);
      if (loaded.isVisible !== shape.visible) this.#isQuiet = false;
      loaded.isVisible = shape.visible;
      if (loaded.isVisible && !loaded.loading.isSettled) this.#coming.add(loaded);
      else this.#coming.delete(loaded);
    }
    return () => {
      for (const { delivery, textures } of ended) {
        delivery?.cancel();
        textures.cancel();
      }
    };
  }

  /** The renderer has let go of it already. */
  #end(element: SceneElement, ended: LoadedShape[]): void {
    const shape = this.#shapes.get(element);
    if (shape === undefined) return;
    this.#shapes.delete(element);
    this.#coming.delete(shape);
    shape.loading.abandon();
    ended.push(shape);
  }

  #begin({ element: described, geometry, visible }: ShapeDescription): LoadedShape {
    const element = described as Element;
    const stages = geometry?.patches.map(() => "none" as const) ?? [];
    const loading = new LoadingEvents(
      element,
      () => transfersOf(shape),
      this.#shownBefore.delete(element) ? "base" : "none",
    );
    const textures = new ShapeTextures(this.#textures, {
      onPicture: (role, picture) => {
        this.#renderer.setPicture(element, role, picture);
      },
      onError: (error) => {
        this.#fail(shape, element, error);
      },
      onSettled: () => {
        this.#settle(shape);
      },
    });
    const shape: LoadedShape = {
      geometry,
      stages,
      isVisible: visible,
      loading,
      delivery: undefined,
      textures,
      described: [],
    };
    this.#shapes.set(element, shape);
    this.#isQuiet = false;
    if (geometry === undefined) shape.loading.settle();
    else if (!this.#renderer.isContextLost) this.#deliver(shape, geometry, element);
    return shape;
  }

  /** No shape has anything to say that its element has not said. */
  get isQuiet(): boolean {
    return this.#isQuiet;
  }

  /** Something that is seen is still to come. */
  get isLoading(): boolean {
    return this.#coming.size > 0;
  }

  /** Whether these patches of a shape have something on the screen, as far as there will be anything. */
  shows(element: SceneElement, patches: readonly number[]): boolean {
    const shape = this.#shapes.get(element);
    return (
      shape === undefined ||
      !shape.isVisible ||
      shape.loading.isSettled ||
      patches.every((patch) => shape.stages[patch] !== "none")
    );
  }

  /** Patches whose files are for workers to decode, whatever the GPU can do. */
  get jobsToCome(): number {
    let sum = 0;
    for (const { geometry, isVisible } of this.#shapes.values()) {
      if (isVisible && (geometry?.container === "compact" || geometry?.decode === "cpu"))
        sum += geometry.patches.length;
    }
    return sum;
  }

  /** Loadings of what is seen: what is hidden is fetched when it is shown. */
  get awaited(): readonly LoadingEvents[] {
    return Array.from(this.#shapes.values())
      .filter(({ isVisible }) => isVisible)
      .map(({ loading }) => loading);
  }

  /** Shapes from which this view needs nothing (more) are complete, even if they could be finer. */
  settle(): void {
    for (const shape of this.#shapes.values()) this.#settle(shape);
  }

  tellProgress(): void {
    for (const shape of this.#shapes.values()) {
      const { loading, delivery } = shape;
      if (delivery && shape.isVisible && !loading.isEnded)
        loading.moveOn(progressOf(transfersOf(shape), loading.progress));
    }
  }

  onFrame(): void {
    this.#isQuiet = true;
    for (const { loading, isVisible } of this.#shapes.values()) {
      loading.onFrame(false);
      this.#isQuiet &&= loading.isEnded || !isVisible;
    }
  }

  /** Lets go of everything, but not of the shapes. */
  clear(): void {
    for (const [element, shape] of this.#shapes) {
      this.#renderer.clearShape(element);
      shape.delivery?.cancel();
      shape.delivery = undefined;
      shape.textures.follow([]);
      shape.stages.fill("none");
    }
  }

  /** Asks for it once more. Events go on where they were. */
  deliverAll(): void {
    for (const [element, shape] of this.#shapes) {
      shape.textures.follow(shape.described);
      if (shape.geometry !== undefined) this.#deliver(shape, shape.geometry, element as Element);
    }
  }

  dispose(): void {
    for (const { delivery, textures, loading } of this.#shapes.values()) {
      delivery?.cancel();
      textures.cancel();
      loading.abandon();
    }
    this.#shapes.clear();
    this.#coming.clear();
  }

  #deliver(shape: LoadedShape, geometry: GeometryDescription, element: Element): void {
    shape.delivery = this.#deliveries.join(geometry, {
      onStage: (patch, stage) => {
        this.#renderer.setStage(element, geometry, patch, stage);
        this.#listener.onStage(stage);
        shape.stages[patch] = stage?.name ?? "none";
        // A shape is as far as its last patch; with a first picture as soon as any patch shows.
        shape.loading.reach(displayedStageOf(shape.stages));
        this.#isQuiet = false;
      },
      onError: (error) => {
        this.#fail(shape, element, error);
      },
      onSettled: () => {
        this.#settle(shape);
      },
    });
  }

  /** Where nothing of it is on its way. */
  #settle(shape: LoadedShape): void {
    const { loading, isVisible, delivery, textures } = shape;
    if (loading.isSettled || !isVisible || !this.#listener.maySettle()) return;
    if (delivery?.isSettled !== true || !textures.isSettled) return;
    loading.settle();
    this.#coming.delete(shape);
    this.#isQuiet = false;
    // Events wait for a frame; the last one for no rest of the GPU.
    if (this.isLoading) this.#renderer.requestFrameAtPace();
    else this.#renderer.requestFrame();
  }

  #fail({ loading }: LoadedShape, element: Element, error: DeliveryError): void {
    this.#listener.onError(error, element, loading);
  }
}

function transfersOf({ delivery, textures }: LoadedShape): readonly Readonly<Transfer>[] {
  return [...(delivery?.transfers ?? []), ...textures.transfers];
}

/** How far something is whose parts are at these stages: with a first picture as soon as any of them shows. */
export function displayedStageOf(stages: readonly (StageName | "none")[]): StageName | "none" {
  const least = lowestStageOf(stages);
  return least === "none" && stages.some((stage) => stage !== "none") ? (stageNames[0] ?? "none") : least;
}
