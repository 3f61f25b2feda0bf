// Tells the page of each movement of the camera, by an event, and screen readers where it is after one.

import type { CameraController } from "../navigation/cameraController.ts";
import { orbitOf } from "../navigation/orbit.ts";
import { viewLabelOf } from "./labels.ts";

/** Screen readers hear where the camera is this long after its last movement. */
const announcementDelayMs = 700;

export interface CameraChangeListener {
  /** The camera has moved, or stands for the first time. */
  onChange(detail: Pick<CameraController, "source">): void;
  announce(text: string): void;
}

export class CameraChanges {
  readonly #camera: Pick<CameraController, "pose" | "source" | "viewpointName">;
  readonly #listener: CameraChangeListener;
  #pose: unknown;
  #timer: ReturnType<typeof setTimeout> | undefined;

  constructor(camera: Pick<CameraController, "pose" | "source" | "viewpointName">, listener: CameraChangeListener) {
    this.#camera = camera;
    this.#listener = listener;
  }

  /** Whether the camera stands where it was in the last frame, or there has been none. */
  get isStill(): boolean {
    return this.#pose === undefined || this.#camera.pose === this.#pose;
  }

  /** Call after each frame. */
  onFrame(): void {
    const { pose, source } = this.#camera;
    if (pose === this.#pose) return;
    const isFirst = this.#pose === undefined;
    this.#pose = pose;
    this.#listener.onChange({ source });
    if (!isFirst && source !== "automatic") this.#announceSoon();
  }

  end(): void {
    clearTimeout(this.#timer);
  }

  #announceSoon(): void {
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => {
      const { pose, viewpointName } = this.#camera;
      this.#listener.announce(viewpointName ?? viewLabelOf(orbitOf(pose)));
    }, announcementDelayMs);
  }
}
