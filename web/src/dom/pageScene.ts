// The scene of a page's <x3d>: reads its document, again after each change, displays it, loads its files, and sends
// events to its elements.

import type { DeliveryError } from "../delivery/deliveryError.ts";
import { requireHttp } from "../delivery/inlinedDocument.ts";
import type { AnchorDescription } from "../document/description.ts";
import type { Stage } from "../stage/stage.ts";
import { FontLoading } from "../text/fontLoading.ts";
import { sceneDeliveriesOf, ViewerCore } from "../viewer/viewerCore.ts";
import type { DisplayedSceneHost } from "./displayedScene.ts";
import { DisplayedScene } from "./displayedScene.ts";
import { DocumentObserver } from "./documentObserver.ts";
import type { LoadingEvents } from "./loadingEvents.ts";
import { lowestStageOf } from "./loadingEvents.ts";
import { PageHost } from "./pageHost.ts";
import { PageInlines } from "./pageInlines.ts";
import { pageParts } from "./pageParts.ts";
import { absoluteUrlOf } from "./pagePool.ts";
import type { PageShape, PageShapesListener } from "./pageShapes.ts";
import { PageShapes } from "./pageShapes.ts";
import type { PageSurroundingsListener } from "./pageSurroundings.ts";
import { PageSurroundings } from "./pageSurroundings.ts";
import type { PageView } from "./pageView.ts";
import { SceneAnimation } from "./sceneAnimation.ts";
import type { SceneLoadingListener } from "./sceneLoading.ts";
import { SceneLoading } from "./sceneLoading.ts";

export interface PageSceneListener extends SceneLoadingListener {
  /**
   * What describes the view may have changed: the bound viewpoint, the navigation type in use, those that the scene has
   * to choose from, or its title.
   */
  onDescription(): void;
  /** The scene has been read again and has Anchors, or had some before. */
  onAnchors(anchors: readonly AnchorDescription[]): void;
}

export class PageScene implements PageShapesListener, PageSurroundingsListener, DisplayedSceneHost {
  readonly view: PageView;
  readonly core: ViewerCore<PageShape>;
  readonly shapes: PageShapes;
  readonly inlines = new PageInlines();
  readonly surroundings: PageSurroundings;
  readonly displayed = new DisplayedScene(this);
  readonly loading: SceneLoading;
  readonly animation = new SceneAnimation(this);
  readonly observer: DocumentObserver;
  readonly #listener: PageSceneListener;
  #isLoading = false;

  /** `signal`: aborts when the scene is disposed of. */
  constructor(view: PageView, listener: PageSceneListener, signal: AbortSignal) {
    const { x3d, renderer, resources, previewed } = view;
    const { pool } = resources;
    const deliveries = sceneDeliveriesOf(pool);
    this.view = view;
    this.#listener = listener;
    this.shapes = new PageShapes(renderer, deliveries, this, previewed);
    this.surroundings = new PageSurroundings(renderer.scene.surroundings, deliveries.textures, this);
    const previewStage = lowestStageOf(previewed.map(({ stage }) => stage)); // which all previewed shapes display
    this.loading = new SceneLoading(x3d, this, previewStage, listener);
    const fonts = new FontLoading(
      document.fonts,
      () => {
        this.core.reader.touchTexts();
        this.core.read();
      },
      signal,
    );
    this.core = new ViewerCore<PageShape>({
      x3d,
      pool,
      deliveries,
      shapes: this.shapes,
      reader: { levelOf: (lod) => this.displayed.levelOf(lod) },
      fontEditionOf: (font, text) => fonts.editionOf(font, text),
      inlines: {
        urlOf: (url) => {
          const absoluteUrl = absoluteUrlOf(url);
          requireHttp(absoluteUrl);
          return absoluteUrl;
        },
      },
      parts: pageParts(),
      host: new PageHost(this),
    });
    this.observer = new DocumentObserver(x3d, (records) => {
      this.#read(this.animation.follow(records));
    });
  }

  /** Follows the document from now on. */
  start(): void {
    this.observer.start();
    this.core.read();
    this.animation.start();
  }

  /** Requests files from now on. */
  load(): void {
    this.#isLoading = true;
    this.core.load();
    this.view.resources.prepare(this.shapes);
    this.view.renderer.frames.request();
  }

  /** Call after each frame. */
  onFrame(): void {
    this.animation.onFrame();
    if (!this.#isLoading) return;
    this.loading.onFrame();
    this.followLods();
    this.core.control.followCamera();
  }

  followLods(): void {
    this.displayed.followLods((changed) => {
      for (const lod of changed) this.core.reader.touch(lod);
      this.core.read();
    });
  }

  onStage(stage: Stage | undefined): void {
    this.displayed.followSphere();
    this.view.textureTest.onStage(stage);
  }

  maySettle(): boolean {
    return !this.view.textureTest.isPending;
  }

  onSettled(): void {
    this.view.renderer.frames.request();
  }

  onRequests(): void {
    this.shapes.settle();
    this.loading.requestProgress();
  }

  requestFiles(): void {
    this.core.control.request();
  }

  /** `loading`: the events of the shape or Inline that the file belongs to. */
  onError(error: DeliveryError, element: Element, loading?: LoadingEvents): void {
    this.core.log.error(error.message);
    this.loading.fail(error, element, loading);
  }

  onDescription(): void {
    this.#listener.onDescription();
  }

  onAnchors(anchors: readonly AnchorDescription[]): void {
    this.#listener.onAnchors(anchors);
  }

  warn(message: string): void {
    this.core.log.warn(`<${this.view.x3d.localName}> ${message}`);
  }

  dispose(): void {
    this.observer.stop();
    this.animation.dispose();
    this.core.dispose();
    this.loading.dispose();
  }

  /** Reads what a script has changed. */
  #read(records: readonly MutationRecord[]): void {
    if (records.length === 0) return;
    const { reader } = this.core;
    for (const { target, type, attributeName } of records) {
      if (type === "childList") reader.rearrange(target as Element);
      else reader.touchAttribute(target as Element, attributeName);
    }
    this.core.read();
    this.core.whenDisplayed(() => {
      for (const { target, attributeName } of records) this.displayed.followBind(target as Element, attributeName);
    });
  }
}
