// <imgeo-view>: the element inside an <x3d> that displays its scene. <x3d> itself is no
// custom element and cannot have a shadow root.

import type { Orbit } from "../navigation/orbit.ts";
import { orbitOf } from "../navigation/orbit.ts";
import { contextOf } from "../render/context.ts";
import type { ImgeoViewer } from "../element/imgeoViewer.ts";
import { viewMethods, viewProperties } from "../element/viewMembers.ts";
import { regionLabelOf } from "./labels.ts";
import { makeUserInterface } from "./userInterface.ts";
import { takePreview } from "../preview/previewRegistry.ts";
import type { Loadable } from "./loadingEvents.ts";
import { LoadingEvents } from "./loadingEvents.ts";
import { pixelAt } from "./shapePointerEvents.ts";
import { ViewController } from "./viewController.ts";
import type { Vector3D } from "./shapePointerEvent.ts";
import { vector3DOf } from "./shapePointerEvent.ts";
import type { ViewStatistics } from "./pageViewer.ts";

const noWebGlMessage =
  "This page shows a 3D scene, for which the browser needs WebGL 2. It is missing or switched off here.";

export interface BlobOptions {
  readonly mimeType?: string;
  /** 0 … 1, for lossy formats. */
  readonly qualityArgument?: number;
}

/** A viewpoint of the scene, for a page's own list. */
export interface ViewpointEntry {
  readonly element: Element;
  readonly description: string;
  readonly isBound: boolean;
}

/** A point on a shape. */
export interface SurfacePoint {
  readonly position: Vector3D;
  /** Unit vector; null on points and lines without normals. */
  readonly normal: Vector3D | null;
  readonly shape: Element;
}

export class ImgeoView extends HTMLElement {
  #controller: ViewController | undefined;
  #canvas: HTMLCanvasElement | undefined;
  readonly #internals = this.attachInternals();

  constructor() {
    super();
    this.#internals.role = "region"; // a landmark of the page
  }

  /** Counts of frames, requests and GPU memory; undefined while the view is not connected. */
  get statistics(): ViewStatistics | undefined {
    return this.#controller?.viewer.statistics;
  }

  /** The scene's viewpoints, in document order. */
  get viewpoints(): readonly ViewpointEntry[] {
    const cameraController = this.#controller?.viewer.cameraController;
    return (cameraController?.viewpoints ?? []).map(({ element, viewpoint }) => ({
      element: element as Element,
      description: viewpoint.description,
      isBound: element === cameraController?.bound,
    }));
  }

  /** Whether automatic rotation is off. */
  get paused(): boolean {
    return this.#controller?.viewer.cameraController.autoRotation.isStopped ?? true;
  }

  /**
   * Starts automatic rotation as `auto-rotate` does, but without delay, and even if the user prefers reduced motion.
   */
  play(): void {
    this.#controller?.play();
  }

  pause(): void {
    this.#controller?.pause();
  }

  /** Removes the poster, which otherwise stays with `reveal="manual"`. */
  dismissPoster(): void {
    this.#controller?.poster.dismiss();
  }

  /** Moves the camera to a viewpoint, given as its element or its description. */
  bindViewpoint(viewpoint: Element | string): void {
    const entry = this.viewpoints.find(
      ({ element, description }) => element === viewpoint || description === viewpoint,
    );
    if (entry) this.#controller?.viewer.cameraController.bind(entry.element);
  }

  /** Moves the camera back to the bound viewpoint. */
  resetView(): void {
    this.#controller?.viewer.cameraController.reset();
  }

  showAll(): void {
    this.#controller?.viewer.cameraController.showAll();
  }

  /** The camera's orbit; as a string in the form of the attribute `camera-orbit`. */
  getCameraOrbit(): Orbit & { toString(): string } {
    const cameraController = this.#controller?.viewer.cameraController;
    const orbit = cameraController ? orbitOf(cameraController.pose) : { theta: 0, phi: 0, radius: 0 };
    return { ...orbit, toString: () => `${orbit.theta}rad ${orbit.phi}rad ${orbit.radius}m` };
  }

  /** The camera's position in scene coordinates. */
  getCameraPosition(): Vector3D {
    return vector3DOf(this.#controller?.viewer.cameraController.pose.position ?? { x: 0, y: 0, z: 0 });
  }

  /**
   * Draws the scene into an image file. Rejects while the view is not connected and when the browser cannot encode the
   * image.
   */
  async toBlob({ mimeType = "image/png", qualityArgument }: BlobOptions = {}): Promise<Blob> {
    const canvas = this.#canvas;
    // Drawn and read in one turn of the event loop: afterwards the canvas' content cannot be read.
    this.#controller?.viewer.renderer.draw();
    const blob = await new Promise<Blob | null>((resolve) => {
      if (canvas === undefined) resolve(null);
      else canvas.toBlob(resolve, mimeType, qualityArgument);
    });
    if (blob === null) throw new Error("the view cannot be encoded as an image");
    return blob;
  }

  /**
   * The visible point of a shape at a position in the viewport, in CSS pixels as clientX and clientY; null where there
   * is no shape.
   */
  positionAndNormalFromPoint(x: number, y: number): SurfacePoint | null {
    if (this.#controller === undefined || this.#canvas === undefined) return null;
    const hit = this.#controller.viewer.renderer.picker.pick(...pixelAt(this.#canvas, x, y));
    if (hit === undefined) return null;
    const { position, normal, element } = hit;
    return { position: vector3DOf(position), normal: normal ? vector3DOf(normal) : null, shape: element as Element };
  }

  /**
   * Refines meshes with levels of detail around a point of the scene first, down to the mesh itself as far as the
   * memory suffices and whatever its size in the view; null: by the view alone. `accuracy` of a hit there becomes 0.
   */
  refineAt(point: { readonly x: number; readonly y: number; readonly z: number } | null): void {
    this.#controller?.viewer.scene.core.control.setFocus(point ? [point.x, point.y, point.z] : undefined);
  }

  connectedCallback(): void {
    const x3d = this.parentElement;
    if (this.#controller !== undefined || x3d === null) return;
    const preview = takePreview(this);
    const ui = makeUserInterface(this.shadowRoot ?? this.attachShadow({ mode: "open" }), preview?.canvas);
    const context = contextOf(ui.canvas);
    if (context === null) {
      preview?.end();
      ui.showMessage(noWebGlMessage);
      reportMissingWebGl(x3d);
      return;
    }
    this.#canvas = ui.canvas;
    this.#controller = new ViewController(x3d, this, ui, context, preview, (label) => {
      this.#internals.ariaLabel = regionLabelOf(label);
    });
    addMembersTo(x3d, this);
    this.#controller.start();
  }

  disconnectedCallback(): void {
    // An element that is being moved is connected again before this runs.
    queueMicrotask(() => {
      if (this.isConnected) return;
      this.#controller?.dispose();
      this.#controller = undefined;
      this.#canvas = undefined;
    });
  }
}

/** The properties that the runtime gives to <x3d>. */
export type ViewElement = Element &
  Loadable &
  Pick<ImgeoView, (typeof viewMethods)[number] | (typeof viewProperties)[number]>;

/** An <imgeo-viewer>, which has the same properties. They are undefined until the runtime has been loaded. */
export type ViewerElement = ImgeoViewer & Omit<ViewElement, keyof Element>;

/** Pages need not look for the <imgeo-view> in an <x3d>. */
function addMembersTo(x3d: Element, view: ImgeoView): void {
  for (const name of viewMethods) {
    Object.defineProperty(x3d, name, { value: view[name].bind(view), configurable: true, enumerable: true });
  }
  for (const name of viewProperties) {
    Object.defineProperty(x3d, name, { get: () => view[name], configurable: true, enumerable: true });
  }
}

/**
 * Reports that no shape can be displayed: by `error` events and rejected promises of all elements, and on the console.
 */
function reportMissingWebGl(x3d: Element): void {
  const error = new Error(noWebGlMessage);
  console.error(`imgeo: ${noWebGlMessage}`);
  for (const element of [x3d, ...x3d.querySelectorAll("shape")]) {
    const loading = new LoadingEvents(element);
    loading.fail({ type: "webgl", url: "", element, message: noWebGlMessage }, error);
    loading.abandon(error);
  }
}
