// The preview of a scene: its base meshes, drawn before the runtime has been loaded.
// Its canvas covers the canvas of the <imgeo-view> until that displays the same shapes. The
// preview follows changes of the document and of the element's size. It ends when its
// picture would differ from the runtime's.

import type { Base } from "../decode/compact/baseBuffers.ts";
import type { SceneElement } from "../document/element.ts";
import { SceneReader } from "../document/sceneReader.ts";
import type { PrefetchedBases, PrefetchedFile } from "./prefetchedBases.ts";
import { PreviewRenderer, isDrawable } from "./previewRenderer.ts";
import type { PreviewScene, PreviewShape } from "./previewScene.ts";
import { previewSceneOf } from "./previewScene.ts";
import { contextOf } from "../render/context.ts";
import { beforeNextFrame } from "../render/frames/nextFrame.ts";
import { cameraSettingOf, readSettings } from "../element/attributes.ts";
import { isSceneNode } from "../element/sceneNodes.ts";
import { deviceSizeOf, observeDeviceSize } from "../element/visibility.ts";

/** A shape that a preview displays. */
export interface PreviewedShape {
  readonly element: SceneElement;
  /** Indices of the patches whose segment of the base has triangles. */
  readonly patches: readonly number[];
}

interface PreviewContent {
  readonly scene: PreviewScene;
  readonly exposure: number;
}

export class Preview {
  readonly canvas: HTMLCanvasElement;
  /** Resolves when all files have been downloaded, or one has failed. */
  readonly downloaded: Promise<unknown>;
  /** Resolves when the preview has been drawn, or has ended. */
  readonly settled: Promise<unknown>;
  /** Called when the preview ends. */
  onEnd: () => void = () => undefined;
  readonly #x3d: Element;
  readonly #renderer: PreviewRenderer;
  readonly #bases = new Map<string, readonly Base[]>();
  readonly #settle: () => void;
  readonly #listeners = new AbortController();
  readonly #baseOf = ({ base }: PreviewShape): Base | undefined =>
    this.#bases.get(absoluteUrlOf(base.url))?.[base.patchIndex];
  #content: PreviewContent;
  #state: "waiting" | "decoding" | "drawn" | "ended" = "waiting";

  /**
   * Requests the bases and draws nothing yet. `insert` puts the canvas into the document. Returns undefined if only the
   * runtime can display the scene.
   */
  static create(
    x3d: Element,
    bases: PrefetchedBases,
    insert: (canvas: HTMLCanvasElement) => void,
  ): Preview | undefined {
    const content = previewContentOf(x3d);
    if (content === undefined) return undefined;
    for (const { base } of content.scene.shapes) bases.fetch(absoluteUrlOf(base.url)); // first, since all that follows takes time
    const canvas = document.createElement("canvas");
    canvas.classList.add("preview");
    canvas.ariaHidden = "true";
    insert(canvas);
    [canvas.width, canvas.height] = deviceSizeOf(canvas); // before the context, so that it allocates its buffers once
    const context = contextOf(canvas);
    if (context !== null) return new Preview(x3d, content, bases, canvas, context);
    canvas.remove();
    return undefined;
  }

  private constructor(
    x3d: Element,
    content: PreviewContent,
    bases: PrefetchedBases,
    canvas: HTMLCanvasElement,
    context: WebGL2RenderingContext,
  ) {
    const { promise, resolve } = Promise.withResolvers<undefined>();
    this.canvas = canvas;
    this.settled = promise;
    this.#settle = () => {
      resolve(undefined);
    };
    this.#x3d = x3d;
    this.#content = content;
    this.#renderer = new PreviewRenderer(context);
    this.#renderer.warmUp(content.scene, canvas.width, canvas.height);
    this.#followChanges();
    const files = Array.from(new Set(content.scene.shapes.map(({ base }) => absoluteUrlOf(base.url))), (url) => ({
      url,
      ...bases.fetch(url),
    }));
    this.downloaded = Promise.all(files.map(({ downloaded }) => downloaded)).catch(() => undefined);
    // If a file fails, the runtime requests it again and reports the error.
    this.#load(files).catch(() => {
      this.end();
    });
  }

  /** Whether all files have been downloaded and the preview will be drawn as soon as they are decoded. */
  get isDue(): boolean {
    return this.#state === "decoding";
  }

  /** The displayed shapes; empty until the preview has been drawn. */
  get shapes(): readonly PreviewedShape[] {
    if (this.#state !== "drawn") return [];
    const shapes = new Map(this.#content.scene.shapes.map((shape) => [shape.element, shape])); // a shape may have several instances
    return Array.from(shapes.values(), (shape) => ({
      element: shape.element,
      patches: (this.#baseOf(shape)?.segments ?? []).flatMap((segment, patch) =>
        segment === undefined ? [] : [patch],
      ),
    }));
  }

  /** Removes the canvas and frees the GPU. */
  end(): void {
    if (this.#state === "ended") return;
    this.#state = "ended";
    this.#listeners.abort();
    this.canvas.remove();
    this.#renderer.dispose();
    this.#settle();
    this.onEnd();
  }

  async #load(files: readonly ({ readonly url: string } & PrefetchedFile)[]): Promise<void> {
    await Promise.all(files.map(({ downloaded }) => downloaded));
    if (this.#state === "waiting") this.#state = "decoding";
    for (const { url, decoded } of files) this.#bases.set(url, (await decoded).bases);
    beforeNextFrame((isHidden) => {
      try {
        if (!isHidden) this.#drawFirstTime();
      } finally {
        if (this.#state !== "drawn") this.end();
      }
    });
  }

  #drawFirstTime(): void {
    if (this.#state !== "decoding") return;
    const [width, height] = deviceSizeOf(this.canvas);
    this.#setSize(width, height);
    if (!this.#draw()) return;
    // Makes the canvas visible. Earlier, the compositor would wait for the GPU's warm-up, and the page for the
    // compositor.
    this.canvas.classList.add("drawn");
    this.#state = "drawn";
    this.#settle();
    for (const element of new Set([
      ...this.#content.scene.shapes.map((shape) => shape.element as Element),
      this.#x3d,
    ])) {
      element.dispatchEvent(new CustomEvent("first-image", { detail: { stage: "base" }, bubbles: false }));
    }
  }

  /**
   * Draws the scene. Ends the preview and returns false if the bases contradict the document or the canvas has no area.
   */
  #draw(): boolean {
    const { scene, exposure } = this.#content;
    const { width, height } = this.canvas;
    const areDrawable = scene.shapes.every((shape) => isDrawable(shape, this.#baseOf(shape)));
    if (areDrawable && width > 0 && height > 0) this.#renderer.draw(scene, this.#baseOf, width, height, exposure);
    else this.end();
    return this.#state !== "ended";
  }

  /** Returns whether the size has changed. Setting the same size again would clear the canvas. */
  #setSize(width: number, height: number): boolean {
    const { canvas } = this;
    if (width === canvas.width && height === canvas.height) return false;
    canvas.width = width;
    canvas.height = height;
    return true;
  }

  #followChanges(): void {
    const { signal } = this.#listeners;
    this.canvas.addEventListener(
      "webglcontextlost",
      () => {
        this.end();
      },
      { signal },
    );
    const observer = new MutationObserver((records) => {
      if (records.some(({ target }) => isSceneNode(target, this.#x3d))) this.#update();
    });
    observer.observe(this.#x3d, { subtree: true, childList: true, attributes: true });
    signal.addEventListener("abort", () => {
      observer.disconnect();
    });
    observeDeviceSize(this.canvas, signal, (width, height) => {
      if (this.#state === "drawn" && this.#setSize(width, height)) this.#draw();
    });
  }

  #update(): void {
    const content = this.#x3d.isConnected ? previewContentOf(this.#x3d) : undefined;
    const needsOtherBases = content?.scene.shapes.some(
      ({ base }) => this.#state === "drawn" && !this.#bases.has(absoluteUrlOf(base.url)),
    );
    if (content === undefined || needsOtherBases === true) {
      this.end();
      return;
    }
    this.#content = content;
    if (this.#state === "drawn") this.#draw();
  }
}

/** Documents with more Shape elements are not read for a preview, which would not draw so many. */
const maxShapeElements = 4096;

/** The scene that the document describes now; undefined if only the runtime can display it. */
function previewContentOf(x3d: Element): PreviewContent | undefined {
  const settings = readSettings(x3d, () => undefined);
  if (settings["draw-as"] !== "surface" || settings.reveal !== "auto") return undefined;
  if (x3d.getElementsByTagName("shape").length > maxShapeElements) return undefined;
  const scene = previewSceneOf(new SceneReader(x3d).read(), cameraSettingOf(settings));
  return scene && { scene, exposure: settings.exposure };
}

function absoluteUrlOf(url: string): string {
  return URL.canParse(url, document.baseURI) ? new URL(url, document.baseURI).href : url;
}
