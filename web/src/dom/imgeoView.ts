// <imgeo-view>: the picture inside an <x3d>. <x3d> itself is no custom element
// and can have no shadow root, so the runtime puts this one into it.

import { contextOf } from "../render/sceneRenderer.ts";
import { listenForMovement } from "./controls.ts";
import { makeFace } from "./face.ts";
import { Loading } from "./loading.ts";
import { listenForPointing, pixelAt } from "./pointing.ts";
import type { Vector3D } from "./shapeEvents.ts";
import { vector3DOf } from "./shapeEvents.ts";
import type { ViewStatistics } from "./viewer.ts";
import { Viewer } from "./viewer.ts";

export const viewTag = "imgeo-view";

const noWebGl = "This page shows a 3D scene, for which the browser needs WebGL 2. It is missing or switched off here.";

/** A place on a shape. */
export interface SurfacePoint {
  readonly position: Vector3D;
  /** Of length 1; null on points and lines without normals. */
  readonly normal: Vector3D | null;
  readonly shape: Element;
}

export class ImgeoView extends HTMLElement {
  #viewer: Viewer | undefined;
  #canvas: HTMLCanvasElement | undefined;
  #listeners = new AbortController();

  /** What has been drawn, requested, and is held on the GPU; undefined without a picture. */
  get statistics(): ViewStatistics | undefined {
    return this.#viewer?.statistics;
  }

  /** What is seen at a point of the window, in CSS pixels as events' clientX and clientY; null where no shape is. */
  positionAndNormalFromPoint(x: number, y: number): SurfacePoint | null {
    if (this.#viewer === undefined || this.#canvas === undefined) return null;
    const hit = this.#viewer.renderer.pick(...pixelAt(this.#canvas, x, y));
    if (hit === undefined) return null;
    const { position, normal, element } = hit;
    return { position: vector3DOf(position), normal: normal ? vector3DOf(normal) : null, shape: element as Element };
  }

  connectedCallback(): void {
    const x3d = this.parentElement;
    if (this.#viewer !== undefined || x3d === null) return;
    const root = this.shadowRoot ?? this.attachShadow({ mode: "open" });
    root.replaceChildren();
    const face = makeFace(root, x3d.getAttribute("aria-label") ?? x3d.getAttribute("title") ?? labelOf(x3d));
    const context = contextOf(face.canvas);
    if (context === null) {
      face.showMessage(noWebGl);
      refuse(x3d);
      return;
    }
    this.#listeners = new AbortController();
    const viewer = new Viewer(x3d, face.canvas, context, (share) => { face.showProgress(share); });
    this.#viewer = viewer;
    // Known before the first request: what is asked for first depends on what is seen.
    viewer.renderer.setSize(...sizeOf(face.canvas));
    viewer.start();
    this.#canvas = face.canvas;
    listenForPointing(face.canvas, this, viewer.renderer, this.#listeners.signal);
    listenForMovement(face.canvas, viewer.navigator, this.#listeners.signal);
    watchSize(face.canvas, this.#listeners.signal, (width, height, ratio) => { viewer.renderer.resize(width, height, ratio); });
  }

  disconnectedCallback(): void {
    // An element that is only being moved is connected again before this runs.
    queueMicrotask(() => {
      if (this.isConnected) return;
      this.#listeners.abort();
      this.#viewer?.dispose();
      this.#viewer = undefined;
    });
  }
}

/** Tells the page that nothing will be shown. */
function refuse(x3d: Element): void {
  const error = new Error(noWebGl);
  console.error(`imgeo: ${noWebGl}`);
  for (const element of [x3d, ...x3d.querySelectorAll("shape")]) {
    const loading = new Loading(element);
    loading.fail({ type: "webgl", url: "", element, message: noWebGl }, error);
    loading.abandon(error);
  }
}

function labelOf(x3d: Element): string {
  return x3d.querySelector("viewpoint")?.getAttribute("description") ?? "3D scene";
}

function sizeOf(canvas: HTMLCanvasElement): [width: number, height: number, ratio: number] {
  const { width, height } = canvas.getBoundingClientRect();
  return [devicePixels(width, undefined), devicePixels(height, undefined), devicePixelRatio];
}

/** Tells the canvas' size in device pixels, now and whenever it or the pixel ratio changes. */
function watchSize(canvas: HTMLCanvasElement, signal: AbortSignal,
                   onSize: (width: number, height: number, ratio: number) => void): void {
  const observer = new ResizeObserver((entries) => {
    for (const { contentRect, devicePixelContentBoxSize } of entries) {
      // Not every browser tells device pixels.
      const exact = (devicePixelContentBoxSize as readonly ResizeObserverSize[] | undefined)?.[0];
      onSize(devicePixels(contentRect.width, exact?.inlineSize),
             devicePixels(contentRect.height, exact?.blockSize), devicePixelRatio);
    }
  });
  try {
    observer.observe(canvas, { box: "device-pixel-content-box" });
  } catch {
    observer.observe(canvas);
  }
  signal.addEventListener("abort", () => { observer.disconnect(); });
}

/** What the browser says it is, unless that is more than a rounding away: an emulated pixel ratio is not in it. */
function devicePixels(cssPixels: number, exact: number | undefined): number {
  const product = cssPixels * devicePixelRatio;
  return exact !== undefined && Math.abs(exact - product) <= 1 ? exact : Math.round(product);
}
