// What hands and keys can do to the camera: the navigator's movements, less what
// the page's author has switched off.

import type { NavigationType } from "../navigation/navigationType.ts";
import type { CameraController } from "../navigation/cameraController.ts";
import type { MovementInput } from "../navigation/firstPerson.ts";

export interface CameraInputLimits {
  /** Nothing moves. */
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

  /** How one moves now; setting what the scene does not allow does nothing. */
  get type(): NavigationType {
    return this.#limits().isDisabled ? "none" : this.#navigator.type;
  }

  set type(type: NavigationType) {
    this.#navigator.type = type;
  }

  get canZoom(): boolean {
    const { isDisabled: isStill, canZoom } = this.#limits();
    return canZoom && !isStill;
  }

  /** Radians to the right and over the top. */
  turn(right: number, over: number): void {
    if (this.type !== "none") this.#navigator.turn(right, over);
  }

  /** Multiplies the distance to what is seen. */
  zoom(factor: number): void {
    if (this.canZoom) this.#navigator.zoom(factor);
  }

  /** Shares of the view's shorter side by which the scene follows the hand. */
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
