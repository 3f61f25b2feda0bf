// Camera input from pointers and keys: passes movements to the navigator, unless the
// page's author has disabled them.

import type { NavigationType } from "../navigation/navigationType.ts";
import type { CameraController } from "../navigation/cameraController.ts";
import type { MovementInput } from "../navigation/firstPerson.ts";

export interface CameraInputLimits {
  /** Ignores all input. */
  readonly isDisabled: boolean;
  readonly canZoom: boolean;
  readonly canPan: boolean;
}

export class CameraInput {
  readonly #navigator: CameraController;
  readonly #limits: () => CameraInputLimits;

  constructor(navigator: CameraController, limits: () => CameraInputLimits) {
    this.#navigator = navigator;
    this.#limits = limits;
  }

  /** The navigation type in use. Setting a type that the scene does not allow has no effect. */
  get type(): NavigationType {
    return this.#limits().isDisabled ? "none" : this.#navigator.type;
  }

  set type(type: NavigationType) {
    this.#navigator.type = type;
  }

  get canZoom(): boolean {
    const { isDisabled, canZoom } = this.#limits();
    return canZoom && !isDisabled;
  }

  /** Turns by radians to the right and over the top. */
  turn(right: number, over: number): void {
    if (this.type !== "none") this.#navigator.turn(right, over);
  }

  /** Multiplies the camera's distance to its target. */
  zoom(factor: number): void {
    if (this.canZoom) this.#navigator.zoom(factor);
  }

  /** Moves the scene by fractions of the view's shorter side. */
  pan(right: number, up: number): void {
    if (this.type !== "none" && this.#limits().canPan) this.#navigator.pan(right, up);
  }

  move(motion: MovementInput): void {
    if (this.type !== "none") this.#navigator.move(motion);
  }

  reset(): void {
    if (this.type !== "none") this.#navigator.reset();
  }

  showAll(): void {
    if (this.type !== "none") this.#navigator.showAll();
  }
}
