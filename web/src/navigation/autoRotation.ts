// The scene's automatic rotation, which pauses while the user moves the camera.

export class AutoRotation {
  radiansPerSecond = Math.PI / 6;
  /** The length of the pause after the user has moved the camera. */
  delayMs = 3000;
  readonly #onRotating: () => void;
  #state: "stopped" | "paused" | "rotating" = "stopped";
  #timer: ReturnType<typeof setTimeout> | undefined;

  /** `onRotating` is called whenever the rotation begins. */
  constructor(onRotating: () => void) {
    this.#onRotating = onRotating;
  }

  get isRotating(): boolean {
    return this.#state === "rotating";
  }

  /** It neither rotates nor is about to. */
  get isStopped(): boolean {
    return this.#state === "stopped";
  }

  /** Rotates, after the delay or at once. */
  start(isDelayed: boolean): void {
    clearTimeout(this.#timer);
    this.#state = "paused";
    if (isDelayed)
      this.#timer = setTimeout(() => {
        this.#rotate();
      }, this.delayMs);
    else this.#rotate();
  }

  /** Restarts the delay: the user moves the camera. */
  pause(): void {
    if (this.#state !== "stopped") this.start(true);
  }

  stop(): void {
    clearTimeout(this.#timer);
    this.#state = "stopped";
  }

  #rotate(): void {
    this.#state = "rotating";
    this.#onRotating();
  }
}
