// Camera input from the keyboard. In EXAMINE each press or repeat of an arrow key is one
// step; in WALK and FLY the camera moves while the key is held. Tab and all other keys
// keep their meaning in the browser, so that the focus can leave the view.

import type { NavigationType } from "../navigation/navigationType.ts";
import type { MovementInput } from "../navigation/firstPerson.ts";
import { noMovement } from "../navigation/firstPerson.ts";
import type { CameraInput } from "./cameraInput.ts";

/** Steps of a key press in EXAMINE: radians, a fraction of the view's shorter side, and a factor of the distance. */
const turnStep = Math.PI / 36;
const panStep = 0.05;
const zoomStep = 1.1;

/** Listens until `signal` aborts. */
export function listenToKeyboard(canvas: HTMLElement, input: CameraInput, signal: AbortSignal): void {
  /** The motion of each held key, by code. */
  const heldMotions = new Map<string, Partial<MovementInput>>();
  const applyMotions = () => {
    input.move(Array.from(heldMotions.values()).reduce<MovementInput>(sumOf, noMovement));
  };
  const releaseAll = () => {
    if (heldMotions.size === 0) return;
    heldMotions.clear();
    applyMotions();
  };
  canvas.addEventListener(
    "keydown",
    (event) => {
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      const motion = isTravelling(input.type) ? motionOf(event) : undefined;
      const action = motion
        ? () => {
            heldMotions.set(event.code, motion);
            applyMotions();
          }
        : actionOf(event, input, canvas);
      if (action === undefined) return;
      event.preventDefault();
      if (motion === undefined) releaseAll(); // any other action ends movements
      action();
    },
    { signal },
  );
  canvas.addEventListener(
    "keyup",
    (event) => {
      if (heldMotions.delete(event.code)) applyMotions();
    },
    { signal },
  );
  // Without the focus there is no keyup event.
  canvas.addEventListener("blur", releaseAll, { signal });
}

function isTravelling(type: NavigationType): boolean {
  return type === "walk" || type === "fly";
}

/** The motion of a held key in WALK and FLY; undefined for other keys. */
function motionOf({ key, shiftKey }: KeyboardEvent): Partial<MovementInput> | undefined {
  switch (key) {
    case "ArrowUp":
      return shiftKey ? { look: 1 } : { forward: 1 };
    case "ArrowDown":
      return shiftKey ? { look: -1 } : { forward: -1 };
    case "ArrowLeft":
      return shiftKey ? { right: -1 } : { turn: -1 };
    case "ArrowRight":
      return shiftKey ? { right: 1 } : { turn: 1 };
    case "PageUp":
      return { up: 1 };
    case "PageDown":
      return { up: -1 };
    default:
      return undefined;
  }
}

function sumOf(motion: MovementInput, other: Partial<MovementInput>): MovementInput {
  const sum = (axis: keyof MovementInput) => Math.max(-1, Math.min(1, motion[axis] + (other[axis] ?? 0)));
  return { forward: sum("forward"), right: sum("right"), up: sum("up"), turn: sum("turn"), look: sum("look") };
}

/** The action of a key that is not held to move; undefined where the key keeps its meaning in the browser. */
function actionOf(event: KeyboardEvent, input: CameraInput, canvas: HTMLElement): (() => void) | undefined {
  const arrow = (right: number, up: number) =>
    event.shiftKey
      ? () => {
          input.pan(right * panStep, up * panStep);
        }
      : () => {
          input.turn(right * turnStep, up * -turnStep);
        };
  switch (event.key) {
    case "e":
    case "E":
      return () => {
        input.type = "examine";
      };
    case "w":
    case "W":
      return () => {
        input.type = "walk";
      };
    case "f":
    case "F":
      return () => {
        input.type = "fly";
      };
    case "Escape":
      return () => {
        canvas.blur();
      };
  }
  if (input.type === "none") return undefined; // arrows scroll the page
  switch (event.key) {
    case "ArrowLeft":
      return arrow(-1, 0);
    case "ArrowRight":
      return arrow(1, 0);
    case "ArrowUp":
      return arrow(0, 1);
    case "ArrowDown":
      return arrow(0, -1);
    case "+":
    case "=":
    case "PageUp":
      return !input.canZoom
        ? undefined
        : () => {
            input.zoom(1 / zoomStep);
          };
    case "-":
    case "_":
    case "PageDown":
      return !input.canZoom
        ? undefined
        : () => {
            input.zoom(zoomStep);
          };
    case "r":
    case "R":
      return () => {
        input.reset();
      };
    case "a":
    case "A":
      return () => {
        input.showAll();
      };
    default:
      return undefined;
  }
}
