// Mouse and touch -> movements of the camera. No inertia: the picture stands
// still when the hand does, which also is what `prefers-reduced-motion` asks for.

import type { CameraInput } from "./cameraInput.ts";
import { listenToKeyboard } from "./keyboardInput.ts";

const radiansPerView = Math.PI;

/** Listens until `signal` aborts. */
export function listenForCameraInput(canvas: HTMLCanvasElement, hands: CameraInput, signal: AbortSignal): void {
  listenToPointers(canvas, hands, signal);
  canvas.addEventListener(
    "wheel",
    (event) => {
      if (!hands.canZoom) return; // the page scrolls
      event.preventDefault();
      const pixels = event.deltaY * (event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 16 : 1);
      hands.zoom(Math.exp(clamp(pixels, 200) / 500));
    },
    { passive: false, signal },
  );
  listenToKeyboard(canvas, hands, signal);
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

/** One pointer turns (with Shift or another button it pans), two pan by their middle and zoom by their distance. */
function listenToPointers(canvas: HTMLCanvasElement, hands: CameraInput, signal: AbortSignal): void {
  const down = new Map<number, Point>();

  const lift = (event: PointerEvent) => {
    down.delete(event.pointerId);
  };
  canvas.addEventListener("pointerup", lift, { signal });
  canvas.addEventListener("pointercancel", lift, { signal });
  canvas.addEventListener(
    "pointerdown",
    (event) => {
      if (event.defaultPrevented || down.size === 2 || hands.type === "none") return;
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
        hands.pan(right / 2, -below / 2);
        hands.zoom(Math.max(distance(from, other), 1) / Math.max(distance(to, other), 1));
      } else if (event.shiftKey || (event.buttons & 6) !== 0) {
        hands.pan(right, -below);
      } else {
        hands.turn(right * radiansPerView, below * radiansPerView);
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
