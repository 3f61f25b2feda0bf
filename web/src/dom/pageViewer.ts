// The viewer of a page's <x3d>: its scene, displayed on the canvas of the <imgeo-view> from where a camera is.

import type { LevelStatistics } from "../delivery/geometryView.ts";
import { CameraController } from "../navigation/cameraController.ts";
import type { Preview } from "../preview/preview.ts";
import type { RenderStatistics } from "../render/sceneRenderer.ts";
import { SceneRenderer } from "../render/sceneRenderer.ts";
import { pageParts } from "./pageParts.ts";
import { PageResources } from "./pageResources.ts";
import type { PageSceneListener } from "./pageScene.ts";
import { PageScene } from "./pageScene.ts";
import { Redelivery } from "./redelivery.ts";
import { TextureReadTest } from "./textureReadTest.ts";
import { followNavigationType } from "./walkingPart.ts";

export interface ViewStatistics extends RenderStatistics {
  /** Requests ever sent, retries included. */
  readonly requests: number;
  readonly openRequests: number;
  /** Meshes with levels of detail. */
  readonly levels: LevelStatistics;
}

export interface PageViewerListener extends PageSceneListener {
  /** A frame has been drawn, or is shown by the preview. The events that wait for it follow. */
  onFrame(): void;
  /** Whether the preview shows the picture that the next requested frame would have. */
  isShownByPreview(): boolean;
}

export class PageViewer {
  readonly renderer: SceneRenderer;
  readonly cameraController: CameraController;
  readonly scene: PageScene;
  readonly #redelivery: Redelivery;
  readonly #listeners = new AbortController();
  readonly #listener: PageViewerListener;

  /** `preview`: displays shapes, and has begun to load patches. */
  constructor(
    x3d: Element,
    canvas: HTMLCanvasElement,
    context: WebGL2RenderingContext,
    listener: PageViewerListener,
    preview: Pick<Preview, "shapes" | "early"> | undefined,
  ) {
    const { signal } = this.#listeners;
    this.#listener = listener;
    const cameraController = (this.cameraController = new CameraController(
      () => {
        this.renderer.frames.request();
      },
      () => {
        this.#onNavigation();
      },
    ));
    const renderer = (this.renderer = new SceneRenderer(canvas, context, cameraController, {
      onFrame: () => {
        this.#onFrame();
      },
      isShownElsewhere: () => listener.isShownByPreview(),
    }));
    const textureTest = new TextureReadTest(renderer);
    const resources = new PageResources(renderer, preview, {
      readsTextures: () => textureTest.readsTextures,
      onTransfer: () => {
        this.scene.loading.requestProgress();
      },
    });
    const view = { x3d, canvas, renderer, cameraController, resources, textureTest, previewed: preview?.shapes ?? [] };
    this.scene = new PageScene(view, listener, signal);
    this.#redelivery = new Redelivery(this.scene, renderer, textureTest, signal);
  }

  /** Follows the document from now on. */
  start(): void {
    const { canvas, resources } = this.scene.view;
    this.#redelivery.start(canvas);
    resources.start(this.#listeners.signal);
    this.scene.start();
  }

  get statistics(): ViewStatistics {
    const { statistics } = this.renderer;
    const { core, view } = this.scene;
    return {
      ...statistics,
      ...view.resources.counts,
      isFrameDue: statistics.isFrameDue || core.isLoadingParts,
      levels: core.deliveries.geometries.levelStatistics,
    };
  }

  /** Aborts all requests and frees the GPU. */
  dispose(): void {
    this.#listeners.abort();
    this.scene.dispose();
    this.scene.view.resources.dispose();
    this.renderer.dispose();
  }

  #onFrame(): void {
    if (!this.scene.core.hasBegun) return; // an empty frame while the scene's parts of the runtime are loaded
    this.#listener.onFrame();
    this.scene.onFrame();
    this.#redelivery.onFrame();
  }

  #onNavigation(): void {
    followNavigationType(this.cameraController, pageParts().walking, this.scene.core.log, () => {
      if (!this.#listeners.signal.aborted) this.renderer.frames.request();
    });
    this.#listener.onDescription();
  }
}
