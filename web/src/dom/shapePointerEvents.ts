// The pointer on shapes. The browser knows one canvas; here its events are taken
// from there and sent from the <shape> that is seen at their place, so that they
// bubble through the document as if each shape were painted by itself. Where no
// shape is, they are the view's as ever.
//
// Hovering never waits for the GPU; what happens on a press does, because a page
// that prevents its default must be heard before the camera moves.

import type { Hit } from "../render/picking/picker.ts";
import { shapePointerEventOf } from "./shapePointerEvent.ts";

export interface Pickable {
  /** In pixels of the canvas' buffer, from its top left. */
  pick(x: number, y: number): Hit | undefined;
  pickAsync(x: number, y: number): Promise<Hit | undefined>;
}

/** Hears of the pointer what happens by itself, after pages have heard of it. */
export interface ShapePointerListener {
  /** The pointer is on this now; undefined: on no shape. */
  onHover(hit: Hit | undefined): void;
  /** Nobody has prevented it. */
  onClick(hit: Hit, native: MouseEvent): void;
}

const redirected = [
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

/** CSS pixels that a finger or hand may tremble in a click; farther is a drag, and the camera's. */
const maxClickMovement = 5;

/** Listens until `signal` aborts; before whatever moves the camera, so that it sees what pages have prevented. */
export function sendShapePointerEvents(
  canvas: HTMLCanvasElement,
  view: HTMLElement,
  pickable: Pickable,
  listener: ShapePointerListener,
  signal: AbortSignal,
): void {
  const pointing = new ShapePointerEvents(canvas, view, pickable, listener);
  for (const type of redirected)
    canvas.addEventListener(
      type,
      (event) => {
        pointing.redirect(event);
      },
      { signal },
    );
  canvas.addEventListener(
    "pointermove",
    (event) => {
      pointing.move(event);
    },
    { signal },
  );
  canvas.addEventListener(
    "mousemove",
    (event) => {
      pointing.keepBack(event);
    },
    { signal },
  );
  for (const type of ["pointerout", "mouseout"] as const) {
    canvas.addEventListener(
      type,
      (event) => {
        pointing.leave(event);
      },
      { signal },
    );
  }
  signal.addEventListener("abort", () => {
    pointing.end();
  });
}

/** Where a button went down, and whether the camera has it since. */
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
  /** The view, or the shape that the pointer is on. */
  #hovered: Element;
  #hit: Hit | undefined;
  #press: Press | undefined;
  /** The latest move that nobody has answered yet. */
  #waiting: PointerEvent | undefined;
  #isPicking = false;
  #isInside = false;

  constructor(canvas: HTMLCanvasElement, view: HTMLElement, pickable: Pickable, listener: ShapePointerListener) {
    this.#canvas = canvas;
    this.#view = view;
    this.#pickable = pickable;
    this.#listener = listener;
    this.#hovered = view;
  }

  /** Sends a press, a release or a click from what is under it, now. */
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
      if (!press.isPrevented) return; // the camera moves, the pointer points at nothing
    }
    native.stopPropagation();
    this.#isInside = true;
    this.#waiting = native;
    if (!this.#isPicking) void this.#answerMoves();
  }

  /** What is sent later from a shape must not arrive now from the view. */
  keepBack(native: MouseEvent): void {
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
    this.#waiting = undefined;
  }

  async #answerMoves(): Promise<void> {
    this.#isPicking = true;
    try {
      for (let native = this.#waiting; native !== undefined; native = this.#waiting) {
        this.#waiting = undefined;
        const hit = await this.#pickable.pickAsync(...this.#pixelOf(native));
        if (!this.#isInside) continue;
        this.#hover(native, hit);
        this.#sendBoth(native, "move", this.#hovered, hit);
      }
    } finally {
      this.#isPicking = false;
    }
  }

  /** After a drag by which the camera moved, and across two shapes, there is no click. */
  #isClickOn(target: Element): boolean {
    const press = this.#press;
    return press === undefined || (press.target === target && (press.isPrevented || !press.hasMoved));
  }

  #release(native: PointerEvent): void {
    // A finger that is lifted points at nothing.
    if (native.pointerType === "touch" && this.#hovered !== this.#view) this.#leaveShape(native, null);
  }

  #hover(native: MouseEvent, hit: Hit | undefined): void {
    const before = this.#hovered;
    const now = targetOf(hit) ?? this.#view;
    if (now !== before) {
      const [left, entered] = [this.#insideScene(before), this.#insideScene(now)];
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
    for (const element of this.#insideScene(shape)) this.#sendBoth(native, "leave", element, this.#hit, relatedTarget);
    this.#hit = undefined;
  }

  /** The element and its ancestors below the one that holds the view. */
  #insideScene(element: Element): Element[] {
    const chain: Element[] = [];
    const outer = this.#view.parentElement;
    if (element === this.#view || outer === null) return chain;
    for (let at: Element | null = element; at !== null && at !== outer; at = at.parentElement) chain.push(at);
    return chain;
  }

  /** As pointer event and, for a mouse, as mouse event. */
  #sendBoth(
    native: MouseEvent,
    what: string,
    target: Element,
    hit: Hit | undefined,
    relatedTarget: EventTarget | null = null,
  ): void {
    this.#send(native, `pointer${what}`, target, hit, relatedTarget);
    if (!(native instanceof PointerEvent) || native.pointerType === "mouse")
      this.#send(native, `mouse${what}`, target, hit, relatedTarget);
  }

  /** False where a listener has prevented the default. */
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

/** The pixel of the canvas' buffer under a point of the window. */
export function pixelAt(canvas: HTMLCanvasElement, clientX: number, clientY: number): [x: number, y: number] {
  const { left, top, width, height } = canvas.getBoundingClientRect();
  return [
    Math.floor(((clientX - left) / width) * canvas.width),
    Math.floor(((clientY - top) / height) * canvas.height),
  ];
}
