// The camera of a canvas: where the camera controller has it, now and in the last frame; the canvas's size; and the
// headlight, which it carries.

import type { Sphere } from "three";
import { DirectionalLight, Matrix4, PerspectiveCamera, Vector2, Vector3 } from "three";
import type { Pose } from "../../navigation/cameraPose.ts";
import { applyPose } from "../../navigation/cameraPose.ts";
import type { CameraController, View } from "../view.ts";

/** Moves the camera. */
export type MovedCamera = Pick<CameraController, "pose" | "clearance" | "advance" | "isMoving">;

export class ViewCamera {
  /** The camera of the next frame, to be added to the scene. */
  readonly current = new PerspectiveCamera();
  /** The camera of the last frame. */
  readonly drawn = new PerspectiveCamera();
  readonly headlight = new DirectionalLight();
  /** A uniform: device pixels per CSS pixel. */
  readonly pixelRatio = { value: 1 };
  /** A uniform: nearest and farthest view depth of the scene in the next frame. */
  readonly depthRange = { value: new Vector2() };
  readonly #controller: MovedCamera;
  #size = { width: 0, height: 0 };
  #isDrawn = false;

  constructor(controller: MovedCamera) {
    this.#controller = controller;
    // The headlight is a child of the camera and shines along its -z.
    this.headlight.position.set(0, 0, 0);
    this.headlight.target.position.set(0, 0, -1);
    this.current.add(this.headlight, this.headlight.target);
  }

  /** The canvas's size in device pixels. */
  get size(): { readonly width: number; readonly height: number } {
    return this.#size;
  }

  get hasArea(): boolean {
    return this.#size.width > 0 && this.#size.height > 0;
  }

  /** Whether `drawn` is the camera of a frame. */
  get isDrawn(): boolean {
    return this.#isDrawn;
  }

  /** Whether another frame is needed after the last one. */
  get isMoving(): boolean {
    return this.#controller.isMoving;
  }

  /** In device pixels, and device pixels per CSS pixel. */
  setSize(width: number, height: number, pixelRatio: number): void {
    this.#size = { width, height };
    if (this.hasArea) this.pixelRatio.value = pixelRatio;
  }

  /** The view of the scene inside `sphere`; undefined while the canvas has no area. */
  viewOf(sphere: Sphere): View | undefined {
    if (!this.hasArea) return undefined;
    const { current } = this;
    this.#setPose(this.#controller.pose, sphere);
    current.updateMatrixWorld();
    return {
      position: current.position.toArray(),
      clipFromScene: new Matrix4().multiplyMatrices(current.projectionMatrix, current.matrixWorldInverse).elements,
      pixelsPerUnit: (current.projectionMatrix.elements[5] * this.#size.height) / 2,
      near: current.near,
    };
  }

  /** Call before a frame of the scene inside `sphere`. `nowMs`: as of `performance.now()`. */
  advance(nowMs: number, sphere: Sphere): void {
    this.#setPose(this.#controller.advance(nowMs), sphere);
    this.depthRange.value.set(this.current.near, this.current.far);
  }

  /** Call after the frame. */
  keep(): void {
    this.drawn.copy(this.current, false);
    this.#isDrawn = true;
  }

  /** The ray from the last frame's camera through a point of the canvas, -1 … 1 from the left and from the bottom. */
  rayAt(x: number, y: number): { origin: [number, number, number]; direction: [number, number, number] } {
    const origin = new Vector3().setFromMatrixPosition(this.drawn.matrixWorld);
    const direction = new Vector3(x, y, 0.5).unproject(this.drawn).sub(origin).normalize();
    return { origin: origin.toArray(), direction: direction.toArray() };
  }

  #setPose(pose: Pose, sphere: Sphere): void {
    applyPose(this.current, pose, this.#size.width / this.#size.height, sphere, this.#controller.clearance);
  }
}
