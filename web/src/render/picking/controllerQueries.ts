// Answers what the camera controller asks about the scene: how far the surface at the camera's center is, and what the
// ground around a walking avatar is like.

import type { Sphere, WebGLRenderer } from "three";
import type { FrameRequests } from "../frames/frameRequests.ts";
import type { ViewCamera } from "../frames/viewCamera.ts";
import type { CameraController } from "../view.ts";
import type { DepthProbe } from "./depthProbe.ts";
import { lateDepthProbe } from "./lateDepthProbe.ts";
import type { PickCandidate } from "./picker.ts";
import type { ScreenPicker } from "./screenPicker.ts";

/** The scene and its last frame. */
export interface QueriedView {
  readonly scene: { readonly shapes: QueriedShapes };
  readonly camera: Pick<ViewCamera, "drawn" | "size">;
  readonly picker: Pick<ScreenPicker, "pickAsync">;
  readonly frames: Pick<FrameRequests, "request">;
}

interface QueriedShapes {
  /** Bounds all visible shapes. */
  readonly sphere: Sphere;
  /** The visible draws, in the camera's view or not. */
  candidatesIgnoringCulling(): readonly PickCandidate[];
}

export class ControllerQueries {
  readonly #renderer: WebGLRenderer;
  readonly #controller: CameraController;
  readonly #view: QueriedView;
  /** Undefined before a camera controller has walked. */
  #depthProbe: DepthProbe | undefined;
  /** Whether a pick for the camera controller is under way. */
  #isSearching = false;

  constructor(renderer: WebGLRenderer, controller: CameraController, view: QueriedView) {
    this.#renderer = renderer;
    this.#controller = controller;
    this.#view = view;
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
    const { camera, picker } = this.#view;
    const center = pose.center.clone().project(camera.drawn);
    const isVisible = Math.abs(center.x) < 1 && Math.abs(center.y) < 1 && Math.abs(center.z) < 1;
    const { width, height } = camera.size;
    this.#isSearching = true;
    try {
      const hit = isVisible
        ? await picker.pickAsync(Math.floor(((1 + center.x) / 2) * width), Math.floor(((1 - center.y) / 2) * height))
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
    const { shapes } = this.#view.scene;
    const { sphere } = shapes;
    const depth = 2 * sphere.radius + sphere.center.distanceTo(depthCamera.eye);
    const samples = await probe.probe(depthCamera, depth, shapes.candidatesIgnoringCulling());
    if (samples === undefined) return;
    this.#controller.addGroundSamples(depthCamera, samples);
    this.#view.frames.request();
  }
}
