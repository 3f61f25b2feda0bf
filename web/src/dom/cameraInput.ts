// Camera input from pointers and keys: passes movements to the camera controller, unless the
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
  readonly #cameraController: CameraController;
  readonly #limits: () => CameraInputLimits;

  constructor(cameraController: CameraController, limits: () => CameraInputLimits) {
    this.#cameraController = cameraController;
    this.#limits = limits;
  }

  /** The navigation type in use. Setting a type that the scene does not allow has no effect. */
  get type(): NavigationType {
    return this.#limits().isDisabled ? "none" : this.#cameraController.type;
  }

  set type(type: NavigationType) {
    this.#cameraController.type = type;
  }

  get canZoom(): boolean {
    const { isDisabled, canZoom } = this.#limits();
    return canZoom && !isDisabled;
  }

  /** Turns the scene by radians to the right and downwards on the screen. */
  turn(right: number, down: number): void {
    if (this.type !== "none") this.#cameraController.turn(right, down);
  }

  /** Multiplies the camera's distance to its target. */
  zoom(factor: number): void {
    if (this.canZoom) this.#cameraController.zoom(factor);
  }

  /** Moves the scene by fractions of the view's shorter side. */
  pan(right: number, up: number): void {
    if (this.type !== "none" && this.#limits().canPan) this.#cameraController.pan(right, up);
  }

  move(motion: MovementInput): void {
    if (this.type !== "none") this.#cameraController.move(motion);
  }

  reset(): void {
    if (this.type !== "none") this.#cameraController.reset();
  }

  showAll(): void {
    if (this.type !== "none") this.#cameraController.showAll();
  }
}
