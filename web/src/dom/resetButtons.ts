// Two buttons that reset the camera: to the whole scene and to the start. They are
// visible after the user has moved the camera. The keys A and R do the same.

import type { CameraController } from "../navigation/cameraController.ts";

export class ResetButtons {
  readonly #cameraController: CameraController;
  readonly #buttons: readonly HTMLButtonElement[];

  constructor(controls: HTMLElement, cameraController: CameraController, signal: AbortSignal) {
    this.#cameraController = cameraController;
    this.#buttons = [
      makeButton(
        "Show all",
        () => {
          cameraController.showAll();
        },
        signal,
      ),
      makeButton(
        "Start",
        () => {
          cameraController.reset();
        },
        signal,
      ),
    ];
    controls.append(...this.#buttons);
  }

  /** Shows or hides the buttons. */
  update(): void {
    const { isAtHome, source, type } = this.#cameraController;
    const isMovedAway = source === "user-interaction" && !isAtHome && type !== "none";
    for (const button of this.#buttons) if (button.hidden === isMovedAway) button.hidden = !isMovedAway;
  }
}

function makeButton(label: string, onClick: () => void, signal: AbortSignal): HTMLButtonElement {
  const button = document.createElement("button");
  button.textContent = label;
  button.setAttribute("part", "ways-back");
  button.tabIndex = -1;
  button.hidden = true;
  button.addEventListener("click", onClick, { signal });
  return button;
}
