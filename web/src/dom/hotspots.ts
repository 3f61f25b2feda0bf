// Hotspots: children of the view with slot="hotspot-…" that stand at a place of
// the scene. They stay the page's own elements, readable and focusable; only
// where they are comes from here, and whether they are seen: whether the surface
// under them faces the camera, and nothing of the scene stands before them.

import type { View } from "../render/view.ts";

type Point = readonly [number, number, number];

interface Hotspot {
  readonly element: HTMLElement;
  readonly frame: HTMLElement;
  readonly position: Point;
  readonly normal: Point | undefined;
  /** In CSS pixels of the picture; undefined beside it. */
  pixel: readonly [x: number, y: number] | undefined;
  isFacing: boolean;
  isCovered: boolean;
  /** What its element has been told; undefined: nothing yet. */
  isSeen: boolean | undefined;
}

/** How a picture is looked at. */
export interface HotspotView {
  /** No other frame is to come unless something happens. */
  readonly isStill: () => boolean;
  /** The place in the scene that is seen at a pixel; undefined where nothing is. */
  readonly placeAt: (x: number, y: number) => Promise<Point | undefined>;
}

/** Something that is nearer to the eye by no more than this share of the way is the hotspot's own surface. */
const slack = 0.02;

export class Hotspots {
  readonly #host: Element;
  readonly #layer: HTMLElement;
  readonly #sight: HotspotView;
  #hotspots: Hotspot[] = [];
  #frameRequest = 0;
  /** Counts frames: what is found out about an earlier one no longer counts. */
  #frame = 0;

  constructor(host: Element, layer: HTMLElement, sight: HotspotView) {
    this.#host = host;
    this.#layer = layer;
    this.#sight = sight;
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
      return [
        {
          element: child,
          frame,
          position,
          normal: pointOf(child.getAttribute("data-normal")),
          pixel: undefined,
          isFacing: true,
          isCovered: false,
          isSeen: undefined,
        },
      ];
    });
    this.#layer.replaceChildren(...this.#hotspots.map(({ frame }) => frame));
  }

  /** Puts all in their places in a picture of this size, in CSS pixels. When it stays, they are looked at. */
  place(view: View, width: number, height: number): void {
    this.#forgetFrame();
    if (this.#hotspots.length === 0) return;
    for (const hotspot of this.#hotspots) placeIn(view, width, height, hotspot);
    this.#frameRequest = requestAnimationFrame(() => {
      if (this.#sight.isStill()) void this.#lookAtAll(view.position, this.#frame);
    });
  }

  dispose(): void {
    this.#forgetFrame();
  }

  #forgetFrame(): void {
    this.#frame += 1;
    cancelAnimationFrame(this.#frameRequest);
  }

  /** One at a time, by the picking pass: no frame is drawn for it. */
  async #lookAtAll(eye: Point, frame: number): Promise<void> {
    for (const hotspot of this.#hotspots) {
      if (hotspot.pixel === undefined || !hotspot.isFacing) continue;
      const found = await this.#sight.placeAt(...hotspot.pixel);
      if (frame !== this.#frame) return;
      hotspot.isCovered =
        found !== undefined && distanceOf(eye, found) < (1 - slack) * distanceOf(eye, hotspot.position);
      tell(hotspot);
    }
  }
}

function placeIn(view: View, width: number, height: number, hotspot: Hotspot): void {
  const { frame, position } = hotspot;
  const [x, y, , w] = clipOf(view.clipFromScene, position);
  const isInView = w > 0 && Math.abs(x) <= w && Math.abs(y) <= w;
  frame.classList.toggle("out-of-view", !isInView);
  hotspot.pixel = isInView ? [((x / w + 1) / 2) * width, ((1 - y / w) / 2) * height] : undefined;
  if (hotspot.pixel) frame.style.transform = `translate(${hotspot.pixel[0]}px, ${hotspot.pixel[1]}px)`;
  hotspot.isFacing = hotspot.normal === undefined || facing(view.position, position, hotspot.normal);
  tell(hotspot);
}

function tell(hotspot: Hotspot): void {
  const { frame, element, isFacing, isCovered } = hotspot;
  const isSeen = isFacing && !isCovered;
  if (isSeen === hotspot.isSeen) return;
  hotspot.isSeen = isSeen;
  frame.classList.toggle("unseen", !isSeen);
  const name = element.getAttribute("data-visibility-attribute");
  if (name !== null && name !== "") element.toggleAttribute(`data-${name}`, isSeen);
  element.dispatchEvent(new CustomEvent("hotspot-visibility", { detail: { visible: isSeen } }));
}

function distanceOf(a: Point, b: Point): number {
  return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

function facing(eye: Point, position: Point, normal: Point): boolean {
  return (
    normal[0] * (eye[0] - position[0]) + normal[1] * (eye[1] - position[1]) + normal[2] * (eye[2] - position[2]) > 0
  );
}

/** Homogeneous coordinates; the matrix column by column. */
function clipOf(matrix: readonly number[], [x, y, z]: Point): [number, number, number, number] {
  const row = (place: number) =>
    (matrix[place] ?? 0) * x + (matrix[place + 4] ?? 0) * y + (matrix[place + 8] ?? 0) * z + (matrix[place + 12] ?? 0);
  return [row(0), row(1), row(2), row(3)];
}

/** "1 2 3", also with <model-viewer>'s "m" behind each number. */
function pointOf(text: string | null): Point | undefined {
  const numbers = (text ?? "")
    .trim()
    .split(/[\s,]+/)
    .map((word) => (word === "" ? NaN : Number(word.replace(/m$/i, ""))));
  const [x, y, z] = numbers;
  if (numbers.length !== 3 || x === undefined || y === undefined || z === undefined) return undefined;
  return numbers.every(Number.isFinite) ? [x, y, z] : undefined;
}
