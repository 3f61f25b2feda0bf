// <imgeo-view>: the picture inside an <x3d>. <x3d> itself is no custom element
// and can have no shadow root, so the runtime puts this one into it.

import type { Orbit } from "../navigation/orbit.ts";
import { orbitOf } from "../navigation/orbit.ts";
import { contextOf } from "../render/context.ts";
import { makeUserInterface } from "./userInterface.ts";
import { takePreview } from "../preview/previewRegistry.ts";
import type { Loadable } from "./loadingEvents.ts";
import { LoadingEvents } from "./loadingEvents.ts";
import { pixelAt } from "./shapePointerEvents.ts";
import { ViewController } from "./viewController.ts";
import type { Vector3D } from "./shapePointerEvent.ts";
import { vector3DOf } from "./shapePointerEvent.ts";
import type { ViewStatistics } from "./pageViewer.ts";

const noWebGl = "This page shows a 3D scene, for which the browser needs WebGL 2. It is missing or switched off here.";

export interface BlobOptions {
  readonly mimeType?: string;
  /** 0 … 1, for formats that lose something. */
  readonly qualityArgument?: number;
}

/** A viewpoint of the scene, for a page's own list. */
export interface ViewpointEntry {
  readonly element: Element;
  readonly description: string;
  readonly isBound: boolean;
}

/** A place on a shape. */
export interface SurfacePoint {
  readonly position: Vector3D;
  /** Of length 1; null on points and lines without normals. */
  readonly normal: Vector3D | null;
  readonly shape: Element;
}

export class ImgeoView extends HTMLElement {
  #presentation: ViewController | undefined;
  #canvas: HTMLCanvasElement | undefined;

  /** What has been drawn, requested, and is held on the GPU; undefined without a picture. */
  get statistics(): ViewStatistics | undefined {
    return this.#presentation?.viewer.statistics;
  }

  /** In document order. */
  get viewpoints(): readonly ViewpointEntry[] {
    const navigator = this.#presentation?.viewer.navigator;
    return (navigator?.viewpoints ?? []).map(({ element, viewpoint }) => ({
      element: element as Element,
      description: viewpoint.description,
      isBound: element === navigator?.bound,
    }));
  }

  /** Does not turn by itself. */
  get paused(): boolean {
    return this.#presentation?.viewer.navigator.autoRotation.isStopped ?? true;
  }

  /** Turns the scene, as `auto-rotate` does, but at once, and also for people who prefer less motion. */
  play(): void {
    this.#presentation?.play();
  }

  pause(): void {
    this.#presentation?.pause();
  }

  /** Takes the poster away; with `reveal="manual"` nothing else does. */
  dismissPoster(): void {
    this.#presentation?.poster.dismiss();
  }

  /** Travels to a viewpoint, given as its element or its description. */
  bindViewpoint(viewpoint: Element | string): void {
    const entry = this.viewpoints.find(
      ({ element, description }) => element === viewpoint || description === viewpoint,
    );
    if (entry) this.#presentation?.viewer.navigator.bind(entry.element);
  }

  /** Travels back to the bound viewpoint. */
  resetView(): void {
    this.#presentation?.viewer.navigator.reset();
  }

  showAll(): void {
    this.#presentation?.viewer.navigator.showAll();
  }

  /** Where the camera is on its orbit; as a string in the form of the attribute `camera-orbit`. */
  getCameraOrbit(): Orbit & { toString(): string } {
    const navigator = this.#presentation?.viewer.navigator;
    const orbit = navigator ? orbitOf(navigator.pose) : { theta: 0, phi: 0, radius: 0 };
    return { ...orbit, toString: () => `${orbit.theta}rad ${orbit.phi}rad ${orbit.radius}m` };
  }

  /** Where the eye is, in the scene's coordinates. */
  getCameraPosition(): Vector3D {
    return vector3DOf(this.#presentation?.viewer.navigator.pose.position ?? { x: 0, y: 0, z: 0 });
  }

  /** The picture as a file. Rejects where there is none. */
  async toBlob({ mimeType = "image/png", qualityArgument }: BlobOptions = {}): Promise<Blob> {
    const canvas = this.#canvas;
    // In one turn of the event loop: afterwards the picture is the browser's alone.
    this.#presentation?.viewer.renderer.draw();
    const blob = await new Promise<Blob | null>((resolve) => {
      if (canvas === undefined) resolve(null);
      else canvas.toBlob(resolve, mimeType, qualityArgument);
    });
    if (blob === null) throw new Error("There is no picture to make a file of.");
    return blob;
  }

  /** What is seen at a point of the window, in CSS pixels as events' clientX and clientY; null where no shape is. */
  positionAndNormalFromPoint(x: number, y: number): SurfacePoint | null {
    if (this.#presentation === undefined || this.#canvas === undefined) return null;
    const hit = this.#presentation.viewer.pick(...pixelAt(this.#canvas, x, y));
    if (hit === undefined) return null;
    const { position, normal, element } = hit;
    return { position: vector3DOf(position), normal: normal ? vector3DOf(normal) : null, shape: element as Element };
  }

  connectedCallback(): void {
    const x3d = this.parentElement;
    if (this.#presentation !== undefined || x3d === null) return;
    const look = takePreview(this);
    const face = makeUserInterface(this.shadowRoot ?? this.attachShadow({ mode: "open" }), look?.canvas);
    const context = contextOf(face.canvas);
    if (context === null) {
      look?.end();
      face.showMessage(noWebGl);
      refuse(x3d);
      return;
    }
    this.#canvas = face.canvas;
    this.#presentation = new ViewController(x3d, this, face, context, look);
    lendMembers(this, x3d);
    this.#presentation.start();
  }

  disconnectedCallback(): void {
    // An element that is only being moved is connected again before this runs.
    queueMicrotask(() => {
      if (this.isConnected) return;
      this.#presentation?.dispose();
      this.#presentation = undefined;
      this.#canvas = undefined;
    });
  }
}

/** What <x3d> can do too, since that is the element that pages know. */
const lentMethods = [
  "play",
  "pause",
  "dismissPoster",
  "bindViewpoint",
  "resetView",
  "showAll",
  "getCameraOrbit",
  "getCameraPosition",
  "toBlob",
  "positionAndNormalFromPoint",
] as const;
const lentProperties = ["statistics", "viewpoints", "paused"] as const;

/** The properties that the runtime gives to <x3d>. */
export type ViewElement = Element &
  Loadable &
  Pick<ImgeoView, (typeof lentMethods)[number] | (typeof lentProperties)[number]>;

function lendMembers(view: ImgeoView, x3d: Element): void {
  for (const name of lentMethods) {
    Object.defineProperty(x3d, name, { value: view[name].bind(view), configurable: true, enumerable: true });
  }
  for (const name of lentProperties) {
    Object.defineProperty(x3d, name, { get: () => view[name], configurable: true, enumerable: true });
  }
}

/** Tells the page that nothing will be shown. */
function refuse(x3d: Element): void {
  const error = new Error(noWebGl);
  console.error(`imgeo: ${noWebGl}`);
  for (const element of [x3d, ...x3d.querySelectorAll("shape")]) {
    const loading = new LoadingEvents(element);
    loading.fail({ type: "webgl", url: "", element, message: noWebGl }, error);
    loading.abandon(error);
  }
}
