// The picture of a scene before the runtime is here: its bases, drawn into a canvas
// that stands before the view's own until that one shows as much. It follows the
// document and the size of the element, and goes where it could only show another
// picture than the runtime will.

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
import { sizeOf, watchSize } from "../element/visibility.ts";

/** What is seen of a shape. */
export interface PreviewedShape {
  readonly element: SceneElement;
  /** Patches whose part of the base has triangles. */
  readonly patches: readonly number[];
}

interface PreviewContent {
  readonly scene: PreviewScene;
  readonly exposure: number;
}

export class Preview {
  readonly canvas: HTMLCanvasElement;
  /** Kept when its files are here, or one of them will not come. */
  readonly arrived: Promise<unknown>;
  /** Kept when it has been drawn, or has gone. */
  readonly settled: Promise<unknown>;
  /** Called when it goes. */
  onEnd: () => void = () => undefined;
  readonly #x3d: Element;
  readonly #picture: PreviewRenderer;
  readonly #bases = new Map<string, readonly Base[]>();
  readonly #settle: () => void;
  readonly #listeners = new AbortController();
  readonly #baseOf = ({ base }: PreviewShape): Base | undefined => this.#bases.get(hrefOf(base.url))?.[base.patchIndex];
  #wanted: PreviewContent;
  #state: "waiting" | "decoding" | "drawn" | "ended" = "waiting";

  /** Undefined where the scene cannot be shown so. The canvas, which `place` puts where it will be seen, is empty at first. */
  static create(x3d: Element, early: PrefetchedBases, place: (canvas: HTMLCanvasElement) => void): Preview | undefined {
    const wanted = previewContentOf(x3d);
    if (wanted === undefined) return undefined;
    for (const { base } of wanted.scene.shapes) early.fetch(hrefOf(base.url)); // before anything that takes time
    const canvas = document.createElement("canvas");
    canvas.classList.add("preview");
    canvas.ariaHidden = "true";
    place(canvas);
    [canvas.width, canvas.height] = sizeOf(canvas); // before it has a context, which then makes its buffers once
    const context = contextOf(canvas);
    if (context !== null) return new Preview(x3d, wanted, early, canvas, context);
    canvas.remove();
    return undefined;
  }

  private constructor(
    x3d: Element,
    wanted: PreviewContent,
    early: PrefetchedBases,
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
    this.#wanted = wanted;
    this.#picture = new PreviewRenderer(context);
    this.#picture.warmUp(wanted.scene, canvas.width, canvas.height);
    this.#follow();
    const files = Array.from(new Set(wanted.scene.shapes.map(({ base }) => hrefOf(base.url))), (url) => ({
      url,
      ...early.fetch(url),
    }));
    this.arrived = Promise.all(files.map(({ downloaded: arrival }) => arrival)).catch(() => undefined);
    this.#load(files).catch(() => {
      this.end();
    }); // the runtime says why
  }

  /** All files are here: it will be drawn with the next frame. */
  get isDue(): boolean {
    return this.#state === "decoding";
  }

  /** Empty until it has been drawn. */
  get shapes(): readonly PreviewedShape[] {
    if (this.#state !== "drawn") return [];
    const shapes = new Map(this.#wanted.scene.shapes.map((shape) => [shape.element, shape])); // one may stand in several places
    return Array.from(shapes.values(), (shape) => ({
      element: shape.element,
      patches: (this.#baseOf(shape)?.segments ?? []).flatMap((part, patch) => (part === undefined ? [] : [patch])),
    }));
  }

  /** Takes it away and frees its GPU. */
  end(): void {
    if (this.#state === "ended") return;
    this.#state = "ended";
    this.#listeners.abort();
    this.canvas.remove();
    this.#picture.dispose();
    this.#settle();
    this.onEnd();
  }

  async #load(files: readonly ({ readonly url: string } & PrefetchedFile)[]): Promise<void> {
    await Promise.all(files.map(({ downloaded: arrival }) => arrival));
    if (this.#state === "waiting") this.#state = "decoding";
    for (const { url, decoded: content } of files) this.#bases.set(url, (await content).bases);
    beforeNextFrame((isUnseen) => {
      try {
        if (!isUnseen) this.#drawFirst();
      } finally {
        if (this.#state !== "drawn") this.end();
      }
    });
  }

  #drawFirst(): void {
    if (this.#state !== "decoding") return;
    const [width, height] = sizeOf(this.canvas);
    this.#setSize(width, height);
    if (!this.#draw()) return;
    // Before, the compositor would wait for what the GPU rehearses, and the page for the compositor.
    this.canvas.classList.add("drawn");
    this.#state = "drawn";
    this.#settle();
    for (const element of new Set([...this.#wanted.scene.shapes.map((shape) => shape.element as Element), this.#x3d])) {
      element.dispatchEvent(new CustomEvent("first-image", { detail: { stage: "base" }, bubbles: false }));
    }
  }

  /** False where it cannot, and has gone. */
  #draw(): boolean {
    const { scene, exposure } = this.#wanted;
    const { width, height } = this.canvas;
    const isWhole = scene.shapes.every((shape) => isDrawable(shape, this.#baseOf(shape)));
    if (isWhole && width > 0 && height > 0) this.#picture.draw(scene, this.#baseOf, width, height, exposure);
    else this.end();
    return this.#state !== "ended";
  }

  /** True where it had another. To set the one that it has would empty it. */
  #setSize(width: number, height: number): boolean {
    const { canvas } = this;
    if (width === canvas.width && height === canvas.height) return false;
    canvas.width = width;
    canvas.height = height;
    return true;
  }

  #follow(): void {
    const { signal } = this.#listeners;
    this.canvas.addEventListener(
      "webglcontextlost",
      () => {
        this.end();
      },
      { signal },
    );
    const observer = new MutationObserver((records) => {
      if (records.some(({ target }) => isSceneNode(target, this.#x3d))) this.#followDocument();
    });
    observer.observe(this.#x3d, { subtree: true, childList: true, attributes: true });
    signal.addEventListener("abort", () => {
      observer.disconnect();
    });
    watchSize(this.canvas, signal, (width, height) => {
      if (this.#state === "drawn" && this.#setSize(width, height)) this.#draw();
    });
  }

  #followDocument(): void {
    const wanted = this.#x3d.isConnected ? previewContentOf(this.#x3d) : undefined;
    const needsOthers = wanted?.scene.shapes.some(
      ({ base }) => this.#state === "drawn" && !this.#bases.has(hrefOf(base.url)),
    );
    if (wanted === undefined || needsOthers === true) {
      this.end();
      return;
    }
    this.#wanted = wanted;
    if (this.#state === "drawn") this.#draw();
  }
}

/** What the document says now; undefined where only the runtime can show it. */
function previewContentOf(x3d: Element): PreviewContent | undefined {
  const settings = readSettings(x3d, () => undefined);
  if (settings["draw-as"] !== "surface" || settings.reveal !== "auto") return undefined;
  const scene = previewSceneOf(new SceneReader(x3d).read(), cameraSettingOf(settings));
  return scene && { scene, exposure: settings.exposure };
}

function hrefOf(url: string): string {
  return URL.canParse(url, document.baseURI) ? new URL(url, document.baseURI).href : url;
}
