// What a page does for the viewer core of its scene: it displays what the core has read, and follows what happens to
// its files.

import type { DeliveryError } from "../delivery/deliveryError.ts";
import type { SceneDescription } from "../document/description.ts";
import type { SceneElement } from "../document/element.ts";
import type { PartName } from "../document/parts.ts";
import type { SceneChanges } from "../render/shapes/shapeChanges.ts";
import type { View } from "../render/view.ts";
import type { NodeInstance } from "../scene/nodeInstance.ts";
import type { ViewerCore, ViewerHost } from "../viewer/viewerCore.ts";
import type { DisplayedScene } from "./displayedScene.ts";
import { inlinedRoots } from "./inlinedRoots.ts";
import type { LoadingEvents } from "./loadingEvents.ts";
import type { PageInlines } from "./pageInlines.ts";
import type { PageShape } from "./pageShapes.ts";
import type { PageSurroundings } from "./pageSurroundings.ts";
import type { PageView } from "./pageView.ts";
import { partsToDisplay } from "./partsToDisplay.ts";
import type { SceneAnimation } from "./sceneAnimation.ts";
import type { SceneLoading } from "./sceneLoading.ts";

/** The page's scene. */
export interface HostedScene {
  readonly view: Pick<PageView, "x3d" | "renderer" | "resources">;
  readonly core: Pick<ViewerCore<PageShape>, "scene" | "inlines">;
  readonly inlines: PageInlines;
  readonly surroundings: PageSurroundings;
  readonly displayed: DisplayedScene;
  readonly loading: SceneLoading;
  readonly animation: SceneAnimation;
  onRequests(): void;
  onError(error: DeliveryError, element: Element, loading: LoadingEvents): void;
  /** Reads the scene again if the camera's distance to a LOD requires another level. */
  followLods(): void;
  /** The title of the scene may be another. */
  onDescription(): void;
}

export class PageHost implements ViewerHost {
  readonly #scene: HostedScene;

  constructor(scene: HostedScene) {
    this.#scene = scene;
  }

  beforeRead(): void {
    this.#scene.animation.writeAttributes();
  }

  partsFor(scene: SceneDescription): readonly PartName[] {
    return partsToDisplay(scene);
  }

  onPartsNeeded(): void {
    this.#scene.loading.join();
  }

  onPartsFailed(error: DeliveryError): void {
    const { loading, view } = this.#scene;
    loading.fail(error, view.x3d);
    view.renderer.frames.request(); // after which the scene is complete, as without any other file
  }

  view(): View | undefined {
    return this.#scene.view.renderer.view;
  }

  sceneTextures(): ReadonlySet<string> {
    return this.#scene.surroundings.textureKeys;
  }

  takeMoved(): readonly NodeInstance[] {
    return this.#scene.view.renderer.scene.shapes.takeMoved();
  }

  display(scene: SceneDescription): SceneChanges {
    return this.#scene.displayed.display(scene);
  }

  onShapes(changes: SceneChanges): void {
    const { view, loading } = this.#scene;
    view.resources.prepareBases(changes);
    loading.join();
  }

  onScene(): void {
    this.#scene.followLods();
  }

  onRequests(): void {
    this.#scene.onRequests();
  }

  onInlineRequested(inline: SceneElement): void {
    const { inlines, core } = this.#scene;
    inlines.onRequested(inline, () => core.inlines.transfersOf(inline));
  }

  onInlineEnd(inline: SceneElement, error: DeliveryError | undefined): void {
    const scene = this.#scene;
    scene.inlines.onEnd(inline, error, (failure, element, loading) => {
      scene.onError(failure, element, loading);
    });
  }

  onInlineRead(): void {
    this.#followInlined();
    this.#scene.onDescription(); // the title may be the document's
  }

  onInlineRemoved(inline: SceneElement): void {
    this.#followInlined();
    this.#scene.inlines.onRemoved(inline);
  }

  #followInlined(): void {
    const { animation, core } = this.#scene;
    animation.followInlined(inlinedRoots(core));
  }
}
