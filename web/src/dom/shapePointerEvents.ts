// Pointer and mouse events on shapes. The browser dispatches them at the canvas; this
// file dispatches copies at the <shape> that is visible at their position, so that they
// bubble through the document. Where there is no shape, the view's own events remain.
//
// Picking for hover events does not wait for the GPU. Picking for presses does, because
// a page may prevent the default before the camera moves.

import type { Hit } from "../render/picking/picker.ts";
import { shapePointerEventOf } from "./shapePointerEvent.ts";

export interface Pickable {
  /** The hit at a pixel of the canvas' buffer, from its top left. Waits for the GPU. */
  pick(x: number, y: number): Hit | undefined;
  pickAsync(x: number, y: number): Promise<Hit | undefined>;
}

/** Default actions, after the page's listeners have run. */
export interface ShapePointerListener {
  /** The pointer is over this hit; undefined: over no shape. */
  onHover(hit: Hit | undefined): void;
  /** A click on a shape whose default has not been prevented. */
  onClick(hit: Hit, native: MouseEvent): void;
}

/** Types of events that are dispatched at a shape at once; moves wait for the GPU. */
const redirectedTypes = [
  "pointerdown",
  "pointerup",
  "pointercancel",
  "mousedown",
  "mouseup",
  "click",
  "auxclick",
  "dblclick",
  "contextmenu",
] as const;

/** CSS pixels that the pointer may move during a click. A longer movement is a drag, which moves the camera. */
const maxClickMovement = 5;

/**
 * Listens until `signal` aborts. Call this before adding camera input, so that camera input sees what pages have
 * prevented.
 */
export function sendShapePointerEvents(
  canvas: HTMLCanvasElement,
  view: HTMLElement,
  pickable: Pickable,
  listener: ShapePointerListener,
  signal: AbortSignal,
): void {
  const shapeEvents = new ShapePointerEvents(canvas, view, pickable, listener);
  for (const type of redirectedTypes)
    canvas.addEventListener(
      type,
      (event) => {
        shapeEvents.redirect(event);
      },
      { signal },
    );
  canvas.addEventListener(
    "pointermove",
    (event) => {
      shapeEvents.move(event);
    },
    { signal },
  );
  canvas.addEventListener(
    "mousemove",
    (event) => {
      shapeEvents.suppress(event);
    },
    { signal },
  );
  for (const type of ["pointerout", "mouseout"] as const) {
    canvas.addEventListener(
      type,
      (event) => {
        shapeEvents.leave(event);
      },
      { signal },
    );
  }
  signal.addEventListener("abort", () => {
    shapeEvents.end();
  });
}

/**
 * The last `pointerdown`: its position in the viewport, its target, and whether the pointer has moved too far for a
 * click since.
 */
interface Press {
  readonly x: number;
  readonly y: number;
  readonly target: Element;
  readonly isPrevented: boolean;
  hasMoved: boolean;
}

class ShapePointerEvents {
  readonly #canvas: HTMLCanvasElement;
  readonly #view: HTMLElement;
  readonly #pickable: Pickable;
  readonly #listener: ShapePointerListener;
  /** The shape under the pointer, or the view. */
  #hovered: Element;
  #hit: Hit | undefined;
  #press: Press | undefined;
  /** The latest move that has not been picked yet. */
  #pendingMove: PointerEvent | undefined;
  #isPicking = false;
  #isInside = false;

  constructor(canvas: HTMLCanvasElement, view: HTMLElement, pickable: Pickable, listener: ShapePointerListener) {
    this.#canvas = canvas;
    this.#view = view;
    this.#pickable = pickable;
    this.#listener = listener;
    this.#hovered = view;
  }

  /** Dispatches a press, a release or a click at the shape under the pointer, synchronously. */
  redirect(native: MouseEvent): void {
    const hit = this.#pickable.pick(...this.#pixelOf(native));
    const target = targetOf(hit) ?? this.#view;
    if (native.type === "click" && !this.#isClickOn(target)) {
      native.stopPropagation();
      return;
    }
    if (native.type === "pointerdown") this.#hover(native, hit);
    const isPrevented = hit !== undefined && !this.#send(native, native.type, target, hit);
    if (hit !== undefined) native.stopPropagation();
    if (isPrevented) native.preventDefault();
    else if (hit !== undefined && native.type === "click") this.#listener.onClick(hit, native);
    if (native.type === "pointerdown") {
      this.#press = { x: native.clientX, y: native.clientY, target, isPrevented, hasMoved: false };
    }
    if (native.type === "pointerup" || native.type === "pointercancel") this.#release(native as PointerEvent);
  }

  move(native: PointerEvent): void {
    const press = this.#press;
    if (press && native.buttons !== 0) {
      press.hasMoved ||= Math.hypot(native.clientX - press.x, native.clientY - press.y) > maxClickMovement;
      if (!press.isPrevented) return; // the drag moves the camera
    }
    native.stopPropagation();
    this.#isInside = true;
    this.#pendingMove = native;
    if (!this.#isPicking) void this.#processMoves();
  }

  /** Stops an event of which a shape gets a copy later. */
  suppress(native: MouseEvent): void {
    if (!this.#press || this.#press.isPrevented || native.buttons === 0) native.stopPropagation();
  }

  leave(native: MouseEvent): void {
    this.end();
    if (this.#hovered === this.#view) return;
    native.stopPropagation();
    if (native instanceof PointerEvent) this.#leaveShape(native, native.relatedTarget);
  }

  end(): void {
    this.#isInside = false;
    this.#pendingMove = undefined;
  }

  async #processMoves(): Promise<void> {
    this.#isPicking = true;
    try {
      for (let native = this.#pendingMove; native !== undefined; native = this.#pendingMove) {
        this.#pendingMove = undefined;
        const hit = await this.#pickable.pickAsync(...this.#pixelOf(native));
        if (!this.#isInside) continue;
        this.#hover(native, hit);
        this.#sendBoth(native, "move", this.#hovered, hit);
      }
    } finally {
      this.#isPicking = false;
    }
  }

  /** There is no click after a drag that has moved the camera, or across two shapes. */
  #isClickOn(target: Element): boolean {
    const press = this.#press;
    return press === undefined || (press.target === target && (press.isPrevented || !press.hasMoved));
  }

  #release(native: PointerEvent): void {
    // A lifted finger hovers over nothing.
    if (native.pointerType === "touch" && this.#hovered !== this.#view) this.#leaveShape(native, null);
  }

  #hover(native: MouseEvent, hit: Hit | undefined): void {
    const before = this.#hovered;
    const now = targetOf(hit) ?? this.#view;
    if (now !== before) {
      const [left, entered] = [this.#pathInScene(before), this.#pathInScene(now)];
      this.#sendBoth(native, "out", before, this.#hit, now);
      for (const element of left)
        if (!entered.includes(element)) this.#sendBoth(native, "leave", element, this.#hit, now);
      this.#hovered = now;
      this.#sendBoth(native, "over", now, hit, before);
      for (const element of entered.reverse())
        if (!left.includes(element)) this.#sendBoth(native, "enter", element, hit, before);
    }
    this.#listener.onHover(hit);
    this.#hit = hit;
  }

  #leaveShape(native: PointerEvent, relatedTarget: EventTarget | null): void {
    const shape = this.#hovered;
    this.#hovered = this.#view;
    this.#listener.onHover(undefined);
    this.#sendBoth(native, "out", shape, this.#hit, relatedTarget);
    for (const element of this.#pathInScene(shape)) this.#sendBoth(native, "leave", element, this.#hit, relatedTarget);
    this.#hit = undefined;
  }

  /** The element and its ancestors below the <x3d>; nothing for the view. */
  #pathInScene(element: Element): Element[] {
    const path: Element[] = [];
    const x3d = this.#view.parentElement;
    if (element === this.#view || x3d === null) return path;
    for (let at: Element | null = element; at !== null && at !== x3d; at = at.parentElement) path.push(at);
    return path;
  }

  /**
   * Dispatches a pointer event and, for a mouse, a mouse event. `action` is "move", "over", "out", "enter" or "leave".
   */
  #sendBoth(
    native: MouseEvent,
    action: string,
    target: Element,
    hit: Hit | undefined,
    relatedTarget: EventTarget | null = null,
  ): void {
    this.#send(native, `pointer${action}`, target, hit, relatedTarget);
    if (!(native instanceof PointerEvent) || native.pointerType === "mouse")
      this.#send(native, `mouse${action}`, target, hit, relatedTarget);
  }

  /** Returns false if a listener has prevented the default. */
  #send(
    native: MouseEvent,
    type: string,
    target: Element,
    hit: Hit | undefined,
    relatedTarget: EventTarget | null = null,
  ): boolean {
    return target.dispatchEvent(shapePointerEventOf(native, type, hit, relatedTarget));
  }

  #pixelOf({ clientX, clientY }: MouseEvent): [x: number, y: number] {
    return pixelAt(this.#canvas, clientX, clientY);
  }
}

function targetOf(hit: Hit | undefined): Element | undefined {
  return hit?.element as Element | undefined;
}

/** The pixel of the canvas' buffer at a position in the viewport. */
export function pixelAt(canvas: HTMLCanvasElement, clientX: number, clientY: number): [x: number, y: number] {
  const { left, top, width, height } = canvas.getBoundingClientRect();
  return [
    Math.floor(((clientX - left) / width) * canvas.width),
    Math.floor(((clientY - top) / height) * canvas.height),
  ];
}
