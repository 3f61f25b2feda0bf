// Hotspots: children of the view with slot="hotspot-…" at positions in the scene. They
// remain the page's own elements, readable and focusable. This file positions them on
// the canvas and tells whether they are visible: whether their shape is, their surface
// faces the camera, and the scene does not cover them. Where labels would overlap, the
// one that is visible, of higher priority, or nearer stays.

import type { View } from "../render/view.ts";
import type { LabelBox } from "./hotspotLabels.ts";
import { displacedLabels } from "./hotspotLabels.ts";
import { hotspotsLabel } from "./overlayLabels.ts";

type Point = readonly [number, number, number];

interface Hotspot {
  readonly element: HTMLElement;
  /** The positioned element in the shadow tree, whose slot displays `element`. */
  readonly container: HTMLElement;
  readonly position: Point;
  readonly normal: Point | undefined;
  /** DEF or id of the shape that the hotspot is about; empty: no particular one. */
  readonly shapeName: string;
  /** Where two overlap, the one of higher priority stays. */
  readonly priority: number;
  /** The position on the canvas in CSS pixels; undefined outside of it. */
  pixel: readonly [x: number, y: number] | undefined;
  isFacing: boolean;
  isCovered: boolean;
  isShapeVisible: boolean;
  isDisplaced: boolean;
  /** As last reported to the element; undefined before. */
  isVisible: boolean | undefined;
}

/** The view that hotspots are displayed in. */
export interface HotspotView {
  /** Whether no frame is due. */
  readonly isStill: () => boolean;
  /** The visible point of the scene at a CSS pixel; undefined where there is none. */
  readonly pointAt: (x: number, y: number) => Promise<Point | undefined>;
  /** Whether the shape of this DEF or id is visible; undefined if the scene has no such shape. */
  readonly isShapeVisible: (name: string) => boolean | undefined;
}

/** A surface nearer than a hotspot by at most this share of the hotspot's distance counts as the hotspot's own. */
const coverTolerance = 0.02;

export class Hotspots {
  readonly #host: Element;
  readonly #layer: HTMLElement;
  readonly #hotspotView: HotspotView;
  #hotspots: Hotspot[] = [];
  #frameRequest = 0;
  /** Number of the current frame: results for an earlier frame are dropped. */
  #frameNumber = 0;
  /** Sizes in CSS pixels. They are observed, because to ask for one would lay out the page in each frame. */
  readonly #sizes = new Map<Element, { readonly width: number; readonly height: number }>();
  readonly #sizeObserver = new ResizeObserver((entries) => {
    for (const { target, borderBoxSize } of entries)
      this.#sizes.set(target, { width: borderBoxSize[0]?.inlineSize ?? 0, height: borderBoxSize[0]?.blockSize ?? 0 });
    this.#displace();
  });
  #eye: Point = [0, 0, 0];

  constructor(host: Element, layer: HTMLElement, hotspotView: HotspotView) {
    this.#host = host;
    this.#layer = layer;
    this.#hotspotView = hotspotView;
  }

  /** Reads the page's hotspots again, after they have changed. */
  read(): void {
    const known = new Map(this.#hotspots.map((hotspot) => [hotspot.element, hotspot]));
    this.#hotspots = Array.from(this.#host.children).flatMap((child) => {
      const position = pointOf(child.getAttribute("data-position"));
      if (!(child instanceof HTMLElement) || !child.slot.startsWith("hotspot") || position === undefined) return [];
      const before = known.get(child);
      const container = before?.container ?? document.createElement("div");
      container.role = "listitem";
      const slot = container.querySelector("slot") ?? container.appendChild(document.createElement("slot"));
      slot.name = child.slot;
      return [
        {
          element: child,
          container,
          position,
          normal: pointOf(child.getAttribute("data-normal")),
          shapeName: child.getAttribute("data-shape")?.trim() ?? "",
          priority: Number(child.getAttribute("data-priority")) || 0,
          pixel: undefined,
          isFacing: before?.isFacing ?? true,
          isCovered: before?.isCovered ?? false,
          isShapeVisible: before?.isShapeVisible ?? true,
          isDisplaced: before?.isDisplaced ?? false,
          isVisible: before?.isVisible,
        },
      ];
    });
    this.#layer.replaceChildren(...this.#hotspots.map(({ container }) => container));
    this.#layer.role = this.#hotspots.length > 0 ? "list" : null; // a list must not be empty
    this.#layer.ariaLabel = this.#hotspots.length > 0 ? hotspotsLabel : null;
    const elements = new Set<Element>(this.#hotspots.map(({ element }) => element));
    for (const element of this.#sizes.keys()) {
      if (elements.has(element)) continue;
      this.#sizes.delete(element);
      this.#sizeObserver.unobserve(element);
    }
    for (const element of elements) this.#sizeObserver.observe(element, { box: "border-box" });
  }

  /**
   * Positions all hotspots for a view of this size in CSS pixels. If no other frame follows, tests whether they are
   * covered.
   */
  update(view: View, width: number, height: number): void {
    this.#invalidateFrame();
    if (this.#hotspots.length === 0) return;
    this.#eye = view.position;
    for (const hotspot of this.#hotspots) {
      hotspot.isShapeVisible =
        hotspot.shapeName === "" || this.#hotspotView.isShapeVisible(hotspot.shapeName) !== false;
      projectInto(view, width, height, hotspot);
    }
    this.#displace();
    this.#frameRequest = requestAnimationFrame(() => {
      if (this.#hotspotView.isStill()) void this.#testVisibility(view.position, this.#frameNumber);
    });
  }

  dispose(): void {
    this.#invalidateFrame();
    this.#sizeObserver.disconnect();
  }

  /** Has labels give way to labels that are visible, of higher priority, or nearer. */
  #displace(): void {
    const labels = this.#hotspots.flatMap((hotspot) => {
      const size = this.#sizes.get(hotspot.element);
      const { pixel, position, priority, isVisible, isShapeVisible, isDisplaced } = hotspot;
      if (pixel === undefined || size === undefined || !isShapeVisible) return [];
      const order = [isVisible === true ? 0 : 1, -priority, distanceOf(this.#eye, position)];
      return [
        { hotspot, x: pixel[0], y: pixel[1], ...size, order, isDisplaced } satisfies LabelBox & { hotspot: Hotspot },
      ];
    });
    const displaced = new Set(Array.from(displacedLabels(labels), ({ hotspot }) => hotspot));
    for (const hotspot of this.#hotspots) {
      hotspot.isDisplaced = displaced.has(hotspot);
      hotspot.container.classList.toggle("displaced", hotspot.isDisplaced);
    }
  }

  #invalidateFrame(): void {
    this.#frameNumber += 1;
    cancelAnimationFrame(this.#frameRequest);
  }

  /** Tests one hotspot after the other by picking, which draws no frame. */
  async #testVisibility(eye: Point, frameNumber: number): Promise<void> {
    for (const hotspot of this.#hotspots) {
      if (hotspot.pixel === undefined || !hotspot.isFacing || !hotspot.isShapeVisible) continue;
      const found = await this.#hotspotView.pointAt(...hotspot.pixel);
      if (frameNumber !== this.#frameNumber) return;
      hotspot.isCovered =
        found !== undefined && distanceOf(eye, found) < (1 - coverTolerance) * distanceOf(eye, hotspot.position);
      sendVisibility(hotspot);
    }
    this.#displace();
  }
}

function projectInto(view: View, width: number, height: number, hotspot: Hotspot): void {
  const { container, position } = hotspot;
  const [x, y, , w] = clipOf(view.clipFromScene, position);
  const isInView = w > 0 && Math.abs(x) <= w && Math.abs(y) <= w;
  container.classList.toggle("out-of-view", !isInView || !hotspot.isShapeVisible);
  hotspot.pixel = isInView ? [((x / w + 1) / 2) * width, ((1 - y / w) / 2) * height] : undefined;
  if (hotspot.pixel) container.style.transform = `translate(${hotspot.pixel[0]}px, ${hotspot.pixel[1]}px)`;
  hotspot.isFacing = hotspot.normal === undefined || isFacingCamera(view.position, position, hotspot.normal);
  sendVisibility(hotspot);
}

function sendVisibility(hotspot: Hotspot): void {
  const { container, element, isFacing, isCovered, isShapeVisible } = hotspot;
  const isVisible = isFacing && !isCovered && isShapeVisible;
  if (isVisible === hotspot.isVisible) return;
  hotspot.isVisible = isVisible;
  container.classList.toggle("unseen", !isVisible);
  const name = element.getAttribute("data-visibility-attribute");
  if (name !== null && name !== "") element.toggleAttribute(`data-${name}`, isVisible);
  element.dispatchEvent(new CustomEvent("hotspot-visibility", { detail: { visible: isVisible } }));
}

function distanceOf(a: Point, b: Point): number {
  return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

function isFacingCamera(eye: Point, position: Point, normal: Point): boolean {
  return (
    normal[0] * (eye[0] - position[0]) + normal[1] * (eye[1] - position[1]) + normal[2] * (eye[2] - position[2]) > 0
  );
}

/** Homogeneous clip coordinates; the matrix is column-major. */
function clipOf(matrix: readonly number[], [x, y, z]: Point): [number, number, number, number] {
  const row = (index: number) =>
    (matrix[index] ?? 0) * x + (matrix[index + 4] ?? 0) * y + (matrix[index + 8] ?? 0) * z + (matrix[index + 12] ?? 0);
  return [row(0), row(1), row(2), row(3)];
}

/** Parses "1 2 3", also with an "m" after each number as <model-viewer> has it. */
function pointOf(text: string | null): Point | undefined {
  const numbers = (text ?? "")
    .trim()
    .split(/[\s,]+/)
    .map((word) => (word === "" ? NaN : Number(word.replace(/m$/i, ""))));
  const [x, y, z] = numbers;
  if (numbers.length !== 3 || x === undefined || y === undefined || z === undefined) return undefined;
  return numbers.every(Number.isFinite) ? [x, y, z] : undefined;
}
