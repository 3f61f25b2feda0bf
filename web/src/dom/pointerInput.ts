// Camera input from mouse, touch and wheel. There is no inertia: the camera stops with
// the pointer, which also respects `prefers-reduced-motion`.

import type { CameraInput } from "./cameraInput.ts";
import { listenToKeyboard } from "./keyboardInput.ts";

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
  // The right button pans.
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

/** One pointer turns the camera, or pans it with Shift or another button. Two pan by their midpoint and zoom by their distance. */
function listenToPointers(canvas: HTMLCanvasElement, input: CameraInput, signal: AbortSignal): void {
  const down = new Map<number, Point>();

  const lift = (event: PointerEvent) => {
    down.delete(event.pointerId);
  };
  canvas.addEventListener("pointerup", lift, { signal });
  canvas.addEventListener("pointercancel", lift, { signal });
  canvas.addEventListener(
    "pointerdown",
    (event) => {
      if (event.defaultPrevented || down.size === 2 || input.type === "none") return;
      down.set(event.pointerId, pointOf(event));
      canvas.setPointerCapture(event.pointerId);
    },
    { signal },
  );
  canvas.addEventListener(
    "pointermove",
    (event) => {
      const from = down.get(event.pointerId);
      if (from === undefined) return;
      const to = pointOf(event);
      const other = Array.from(down).find(([id]) => id !== event.pointerId)?.[1];
      down.set(event.pointerId, to);
      const shorter = Math.min(canvas.clientWidth, canvas.clientHeight) || 1;
      const right = (to.x - from.x) / shorter;
      const below = (to.y - from.y) / shorter;
      if (other !== undefined) {
        input.pan(right / 2, -below / 2);
        input.zoom(Math.max(distance(from, other), 1) / Math.max(distance(to, other), 1));
      } else if (event.shiftKey || (event.buttons & 6) !== 0) {
        input.pan(right, -below);
      } else {
        input.turn(right * radiansPerView, below * radiansPerView);
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

function clamp(value: number, largest: number): number {
  return Math.max(-largest, Math.min(largest, value));
}
