// The scene turns by itself, until somebody takes it into his hands, and goes on
// a while after he has let go.

export class AutoRotation {
  radiansPerSecond = Math.PI / 6;
  /** How long it rests after somebody has moved the camera. */
  delayMs = 3000;
  readonly #onTurning: () => void;
  #state: "stopped" | "resting" | "turning" = "stopped";
  #timer: ReturnType<typeof setTimeout> | undefined;

  /** `onTurning` is called whenever it begins to turn. */
  constructor(onTurning: () => void) {
    this.#onTurning = onTurning;
  }

  get isRotating(): boolean {
    return this.#state === "turning";
  }

  /** Neither turns nor will. */
  get isStopped(): boolean {
    return this.#state === "stopped";
  }

  /** Turns, after the delay or at once. */
  start(isDelayed: boolean): void {
    clearTimeout(this.#timer);
    this.#state = "resting";
    if (isDelayed)
      this.#timer = setTimeout(() => {
        this.#turn();
      }, this.delayMs);
    else this.#turn();
  }

  /** Somebody moves the camera. */
  pause(): void {
    if (this.#state !== "stopped") this.start(true);
  }

  stop(): void {
    clearTimeout(this.#timer);
    this.#state = "stopped";
  }

  #turn(): void {
    this.#state = "turning";
    this.#onTurning();
  }
}
