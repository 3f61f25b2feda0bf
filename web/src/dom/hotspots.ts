// Hotspots: children of the view with slot="hotspot-…" at positions in the scene. They
// remain the page's own elements, readable and focusable. This file sets where they are
// on the screen, and whether they are visible: whether their surface faces the camera
// and nothing of the scene covers them.

import type { View } from "../render/view.ts";

type Point = readonly [number, number, number];

interface Hotspot {
  readonly element: HTMLElement;
  readonly frame: HTMLElement;
  readonly position: Point;
  readonly normal: Point | undefined;
  /** In CSS pixels of the canvas; undefined outside of it. */
  pixel: readonly [x: number, y: number] | undefined;
  isFacing: boolean;
  isCovered: boolean;
  /** As last reported to the element; undefined before. */
  isVisible: boolean | undefined;
}

/** What hotspots need to know of their view. */
export interface HotspotView {
  /** Whether no frame is due. */
  readonly isStill: () => boolean;
  /** The visible point of the scene at a CSS pixel; undefined where there is none. */
  readonly pointAt: (x: number, y: number) => Promise<Point | undefined>;
}

/** A surface in front of a hotspot by at most this share of the distance counts as the hotspot's own surface. */
const slack = 0.02;

export class Hotspots {
  readonly #host: Element;
  readonly #layer: HTMLElement;
  readonly #hotspotView: HotspotView;
  #hotspots: Hotspot[] = [];
  #frameRequest = 0;
  /** Number of the current frame: results for an earlier frame are dropped. */
  #frame = 0;

  constructor(host: Element, layer: HTMLElement, sight: HotspotView) {
    this.#host = host;
    this.#layer = layer;
    this.#hotspotView = sight;
  }

  /** Reads the page's hotspots again, after they have changed. */
  read(): void {
    const frames = new Map(this.#hotspots.map(({ element, frame }) => [element, frame]));
    this.#hotspots = Array.from(this.#host.children).flatMap((child) => {
      const position = pointOf(child.getAttribute("data-position"));
      if (!(child instanceof HTMLElement) || !child.slot.startsWith("hotspot") || position === undefined) return [];
      const frame = frames.get(child) ?? document.createElement("div");
      const slot = frame.querySelector("slot") ?? frame.appendChild(document.createElement("slot"));
      slot.name = child.slot;
      return [
        {
          element: child,
          frame,
          position,
          normal: pointOf(child.getAttribute("data-normal")),
          pixel: undefined,
          isFacing: true,
          isCovered: false,
          isVisible: undefined,
        },
      ];
    });
    this.#layer.replaceChildren(...this.#hotspots.map(({ frame }) => frame));
  }

  /** Positions all hotspots for a view of this size in CSS pixels. If no other frame follows, tests whether they are covered. */
  update(view: View, width: number, height: number): void {
    this.#invalidateFrame();
    if (this.#hotspots.length === 0) return;
    for (const hotspot of this.#hotspots) projectInto(view, width, height, hotspot);
    this.#frameRequest = requestAnimationFrame(() => {
      if (this.#hotspotView.isStill()) void this.#testVisibility(view.position, this.#frame);
    });
  }

  dispose(): void {
    this.#invalidateFrame();
  }

  #invalidateFrame(): void {
    this.#frame += 1;
    cancelAnimationFrame(this.#frameRequest);
  }

  /** Tests one hotspot after the other by picking, which draws no frame. */
  async #testVisibility(eye: Point, frame: number): Promise<void> {
    for (const hotspot of this.#hotspots) {
      if (hotspot.pixel === undefined || !hotspot.isFacing) continue;
      const found = await this.#hotspotView.pointAt(...hotspot.pixel);
      if (frame !== this.#frame) return;
      hotspot.isCovered =
        found !== undefined && distanceOf(eye, found) < (1 - slack) * distanceOf(eye, hotspot.position);
      sendVisibility(hotspot);
    }
  }
}

function projectInto(view: View, width: number, height: number, hotspot: Hotspot): void {
  const { frame, position } = hotspot;
  const [x, y, , w] = clipOf(view.clipFromScene, position);
  const isInView = w > 0 && Math.abs(x) <= w && Math.abs(y) <= w;
  frame.classList.toggle("out-of-view", !isInView);
  hotspot.pixel = isInView ? [((x / w + 1) / 2) * width, ((1 - y / w) / 2) * height] : undefined;
  if (hotspot.pixel) frame.style.transform = `translate(${hotspot.pixel[0]}px, ${hotspot.pixel[1]}px)`;
  hotspot.isFacing = hotspot.normal === undefined || facing(view.position, position, hotspot.normal);
  sendVisibility(hotspot);
}

function sendVisibility(hotspot: Hotspot): void {
  const { frame, element, isFacing, isCovered } = hotspot;
  const isVisible = isFacing && !isCovered;
  if (isVisible === hotspot.isVisible) return;
  hotspot.isVisible = isVisible;
  frame.classList.toggle("unseen", !isVisible);
  const name = element.getAttribute("data-visibility-attribute");
  if (name !== null && name !== "") element.toggleAttribute(`data-${name}`, isVisible);
  element.dispatchEvent(new CustomEvent("hotspot-visibility", { detail: { visible: isVisible } }));
}

function distanceOf(a: Point, b: Point): number {
  return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

function facing(eye: Point, position: Point, normal: Point): boolean {
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
