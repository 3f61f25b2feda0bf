// Camera input from mouse, touch and wheel. There is no inertia: the camera stops with
// the pointer, which also respects `prefers-reduced-motion`.

import type { CameraInput } from "./cameraInput.ts";
import { listenToKeyboard } from "./keyboardInput.ts";

/** Angle that a drag along the shorter side of the canvas turns by. */
const radiansPerView = Math.PI;

/** Listens until `signal` aborts. */
export function listenForCameraInput(canvas: HTMLCanvasElement, input: CameraInput, signal: AbortSignal): void {
  listenToPointers(canvas, input, signal);
  canvas.addEventListener(
    "wheel",
    (event) => {
      if (!input.canZoom) return; // the page scrolls
      event.preventDefault();
      const pixels = event.deltaY * (event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 16 : 1);
      input.zoom(Math.exp(clamp(pixels, 200) / 500));
    },
    { passive: false, signal },
  );
  listenToKeyboard(canvas, input, signal);
  // The right button pans, so it must not open a menu.
  canvas.addEventListener(
    "contextmenu",
    (event) => {
      event.preventDefault();
    },
    { signal },
  );
}

interface Point {
  readonly x: number;
  readonly y: number;
}

/**
 * One pointer turns the camera, or pans it with Shift or another button. Two pan by their midpoint and zoom by their
 * distance.
 */
function listenToPointers(canvas: HTMLCanvasElement, input: CameraInput, signal: AbortSignal): void {
  /** The last position of each pressed pointer, by id. */
  const pressed = new Map<number, Point>();

  const release = (event: PointerEvent) => {
    pressed.delete(event.pointerId);
  };
  canvas.addEventListener("pointerup", release, { signal });
  canvas.addEventListener("pointercancel", release, { signal });
  canvas.addEventListener(
    "pointerdown",
    (event) => {
      if (event.defaultPrevented || pressed.size === 2 || input.type === "none") return;
      pressed.set(event.pointerId, pointOf(event));
      canvas.setPointerCapture(event.pointerId);
    },
    { signal },
  );
  canvas.addEventListener(
    "pointermove",
    (event) => {
      const from = pressed.get(event.pointerId);
      if (from === undefined) return;
      const to = pointOf(event);
      const other = Array.from(pressed).find(([id]) => id !== event.pointerId)?.[1];
      pressed.set(event.pointerId, to);
      const shorterSide = Math.min(canvas.clientWidth, canvas.clientHeight) || 1;
      const right = (to.x - from.x) / shorterSide;
      const down = (to.y - from.y) / shorterSide;
      if (other !== undefined) {
        input.pan(right / 2, -down / 2);
        input.zoom(Math.max(distance(from, other), 1) / Math.max(distance(to, other), 1));
      } else if (event.shiftKey || (event.buttons & 6) !== 0) {
        input.pan(right, -down);
      } else {
        input.turn(right * radiansPerView, down * radiansPerView);
      }
    },
    { signal },
  );
}

function pointOf(event: PointerEvent): Point {
  return { x: event.clientX, y: event.clientY };
}

function distance(a: Point, b: Point): number {
  return Math.hypot(a.x - b.x, a.y - b.y);
}

function clamp(value: number, limit: number): number {
  return Math.max(-limit, Math.min(limit, value));
}
