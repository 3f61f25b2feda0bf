// Hotspots: children of the view with slot="hotspot-…" that stand at a place of
// the scene. They stay the page's own elements, readable and focusable; only
// where they are, and whether the surface under them faces the camera, comes
// from here.

import type { View } from "../render/view.ts";

type Point = readonly [number, number, number];

interface Hotspot {
  readonly element: HTMLElement;
  readonly frame: HTMLElement;
  readonly position: Point;
  readonly normal: Point | undefined;
  isFacing: boolean | undefined;
}

export class Hotspots {
  readonly #host: Element;
  readonly #layer: HTMLElement;
  #hotspots: Hotspot[] = [];

  constructor(host: Element, layer: HTMLElement) {
    this.#host = host;
    this.#layer = layer;
  }

  /** The page has changed its hotspots, or what it says of them. */
  read(): void {
    const frames = new Map(this.#hotspots.map(({ element, frame }) => [element, frame]));
    this.#hotspots = Array.from(this.#host.children).flatMap((child) => {
      const position = pointOf(child.getAttribute("data-position"));
      if (!(child instanceof HTMLElement) || !child.slot.startsWith("hotspot") || position === undefined) return [];
      const frame = frames.get(child) ?? document.createElement("div");
      const slot = frame.querySelector("slot") ?? frame.appendChild(document.createElement("slot"));
      slot.name = child.slot;
      return [{ element: child, frame, position, normal: pointOf(child.getAttribute("data-normal")), isFacing: undefined }];
    });
    this.#layer.replaceChildren(...this.#hotspots.map(({ frame }) => frame));
  }

  /** Puts all in their places in a picture of this size, in CSS pixels. */
  place(view: View, width: number, height: number): void {
    for (const hotspot of this.#hotspots) placeIn(view, width, height, hotspot);
  }
}

function placeIn(view: View, width: number, height: number, hotspot: Hotspot): void {
  const { frame, element, position } = hotspot;
  const [x, y, , w] = clipOf(view.clipFromScene, position);
  const isInView = w > 0 && Math.abs(x) <= w && Math.abs(y) <= w;
  frame.classList.toggle("out-of-view", !isInView);
  if (isInView) frame.style.transform = `translate(${((x / w + 1) / 2) * width}px, ${((1 - y / w) / 2) * height}px)`;

  const isFacing = hotspot.normal === undefined || facing(view.position, position, hotspot.normal);
  if (isFacing === hotspot.isFacing) return;
  hotspot.isFacing = isFacing;
  frame.classList.toggle("turned-away", !isFacing);
  const name = element.getAttribute("data-visibility-attribute");
  if (name !== null && name !== "") element.toggleAttribute(`data-${name}`, isFacing);
  element.dispatchEvent(new CustomEvent("hotspot-visibility", { detail: { visible: isFacing } }));
}

function facing(eye: Point, position: Point, normal: Point): boolean {
  return normal[0] * (eye[0] - position[0]) + normal[1] * (eye[1] - position[1]) + normal[2] * (eye[2] - position[2]) > 0;
}

/** Homogeneous coordinates; the matrix column by column. */
function clipOf(matrix: readonly number[], [x, y, z]: Point): [number, number, number, number] {
  const row = (place: number) =>
    (matrix[place] ?? 0) * x + (matrix[place + 4] ?? 0) * y + (matrix[place + 8] ?? 0) * z + (matrix[place + 12] ?? 0);
  return [row(0), row(1), row(2), row(3)];
}

/** "1 2 3", also with <model-viewer>'s "m" behind each number. */
function pointOf(text: string | null): Point | undefined {
  const numbers = (text ?? "").trim().split(/[\s,]+/).map((word) => (word === "" ? NaN : Number(word.replace(/m$/i, ""))));
  const [x, y, z] = numbers;
  if (numbers.length !== 3 || x === undefined || y === undefined || z === undefined) return undefined;
  return numbers.every(Number.isFinite) ? [x, y, z] : undefined;
}
