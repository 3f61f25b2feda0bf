// Keys -> movements of the camera. While examining, each press (and repeat) of an
// arrow is one step; while walking or flying one goes on for as long as it is
// held. Tab and everything else stay the browser's, so that nobody is trapped.

import type { NavigationType } from "../navigation/navigationType.ts";
import type { MovementInput } from "../navigation/firstPerson.ts";
import { noMovement } from "../navigation/firstPerson.ts";
import type { CameraInput } from "./cameraInput.ts";

const turnStep = Math.PI / 36;
const panStep = 0.05;
const zoomStep = 1.1;

/** Listens until `signal` aborts. */
export function listenToKeyboard(canvas: HTMLElement, hands: CameraInput, signal: AbortSignal): void {
  const held = new Map<string, Partial<MovementInput>>();
  const moveOn = () => {
    hands.move(Array.from(held.values()).reduce<MovementInput>(together, noMovement));
  };
  const letGo = () => {
    if (held.size === 0) return;
    held.clear();
    moveOn();
  };
  canvas.addEventListener(
    "keydown",
    (event) => {
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      const motion = isTravelling(hands.type) ? motionOf(event) : undefined;
      const act = motion
        ? () => {
            held.set(event.code, motion);
            moveOn();
          }
        : actionOf(event, hands, canvas);
      if (act === undefined) return;
      event.preventDefault();
      if (motion === undefined) letGo(); // R and the like end what is held
      act();
    },
    { signal },
  );
  canvas.addEventListener(
    "keyup",
    (event) => {
      if (held.delete(event.code)) moveOn();
    },
    { signal },
  );
  // Whoever looks away will not tell us that he lets go.
  canvas.addEventListener("blur", letGo, { signal });
}

function isTravelling(type: NavigationType): boolean {
  return type === "walk" || type === "fly";
}

/** What a key that is held does to who walks or flies. */
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

function together(motion: MovementInput, other: Partial<MovementInput>): MovementInput {
  const sum = (part: keyof MovementInput) => Math.max(-1, Math.min(1, motion[part] + (other[part] ?? 0)));
  return { forward: sum("forward"), right: sum("right"), up: sum("up"), turn: sum("turn"), look: sum("look") };
}

/** What a key press does, whoever one is. */
function actionOf(event: KeyboardEvent, hands: CameraInput, canvas: HTMLElement): (() => void) | undefined {
  const arrow = (right: number, up: number) =>
    event.shiftKey
      ? () => {
          hands.pan(right * panStep, up * panStep);
        }
      : () => {
          hands.turn(right * turnStep, up * -turnStep);
        };
  switch (event.key) {
    case "e":
    case "E":
      return () => {
        hands.type = "examine";
      };
    case "w":
    case "W":
      return () => {
        hands.type = "walk";
      };
    case "f":
    case "F":
      return () => {
        hands.type = "fly";
      };
    case "Escape":
      return () => {
        canvas.blur();
      };
  }
  if (hands.type === "none") return undefined; // arrows scroll the page
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
      return !hands.canZoom
        ? undefined
        : () => {
            hands.zoom(1 / zoomStep);
          };
    case "-":
    case "_":
    case "PageDown":
      return !hands.canZoom
        ? undefined
        : () => {
            hands.zoom(zoomStep);
          };
    case "r":
    case "R":
      return () => {
        hands.reset();
      };
    case "a":
    case "A":
      return () => {
        hands.showAll();
      };
    default:
      return undefined;
  }
}
