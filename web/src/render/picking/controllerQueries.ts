// Answers what the camera controller asks about the scene: how far the surface at the camera's center is, and what the
// ground around a walking avatar is like.

import type { PerspectiveCamera, Sphere, WebGLRenderer } from "three";
import type { CameraController } from "../view.ts";
import type { DepthProbe } from "./depthProbe.ts";
import { lateDepthProbe } from "./lateDepthProbe.ts";
import type { Hit, PickCandidate } from "./picker.ts";

/** The scene and its last frame. */
export interface QueriedScene {
  /** The camera of the last frame. */
  readonly camera: PerspectiveCamera;
  /** The canvas's size in device pixels. */
  size(): { readonly width: number; readonly height: number };
  /** The bounding sphere of all visible shapes. */
  sphere(): Sphere;
  pick(x: number, y: number): Promise<Hit | undefined>;
  /** The visible draws, in the camera's view or not. */
  candidates(): readonly PickCandidate[];
  requestFrame(): void;
}

export class ControllerQueries {
  readonly #renderer: WebGLRenderer;
  readonly #controller: CameraController;
  readonly #scene: QueriedScene;
  /** Undefined before a camera controller has walked. */
  #depthProbe: DepthProbe | undefined;
  /** Whether a pick for the camera controller is under way. */
  #isSearching = false;

  constructor(renderer: WebGLRenderer, controller: CameraController, scene: QueriedScene) {
    this.#renderer = renderer;
    this.#controller = controller;
    this.#scene = scene;
  }

  /** Call after each frame. */
  onFrame(): void {
    void this.#sampleGround();
    void this.#searchSurface();
  }

  dispose(): void {
    this.#depthProbe?.dispose();
  }

  /** Picks the surface at the camera's center, if the camera controller needs to know its distance. */
  async #searchSurface(): Promise<void> {
    const pose = this.#isSearching ? undefined : this.#controller.surfaceSearch;
    if (pose === undefined) return;
    const center = pose.center.clone().project(this.#scene.camera);
    const isVisible = Math.abs(center.x) < 1 && Math.abs(center.y) < 1 && Math.abs(center.z) < 1;
    const { width, height } = this.#scene.size();
    this.#isSearching = true;
    try {
      const hit = isVisible
        ? await this.#scene.pick(Math.floor(((1 + center.x) / 2) * width), Math.floor(((1 - center.y) / 2) * height))
        : undefined;
      this.#controller.addSurfaceAhead(pose, hit?.position.distanceTo(pose.position) ?? Infinity);
    } finally {
      this.#isSearching = false;
    }
  }

  /**
   * Draws a depth image of the ground around a walking avatar, if the camera controller needs one, and gives it the
   * samples.
   */
  async #sampleGround(): Promise<void> {
    const depthCamera = this.#depthProbe?.isBusy === true ? undefined : this.#controller.depthCamera;
    if (depthCamera === undefined) return;
    const probe = (this.#depthProbe ??= lateDepthProbe.added?.(this.#renderer));
    if (probe === undefined) return;
    const sphere = this.#scene.sphere();
    const depth = 2 * sphere.radius + sphere.center.distanceTo(depthCamera.eye);
    const samples = await probe.probe(depthCamera, depth, this.#scene.candidates());
    if (samples === undefined) return;
    this.#controller.addGroundSamples(depthCamera, samples);
    this.#scene.requestFrame();
  }
}
