// What moves in a view without input, the automatic rotation and the document's clocks, unless the user prefers reduced
// motion.

import type { ViewSettings } from "../element/attributes.ts";
import type { CameraController } from "../navigation/cameraController.ts";
import type { SceneAnimation } from "./sceneAnimation.ts";

/** The view in which things move. */
export interface MovingView {
  readonly viewer: {
    readonly cameraController: Pick<CameraController, "autoRotation" | "isInstant">;
    readonly scene: { readonly animation: Pick<SceneAnimation, "setMotion"> };
  };
  readonly settings: () => Pick<ViewSettings, "auto-rotate" | "auto-rotate-delay" | "rotation-per-second" | "paused">;
  /** Whether the view shows its scene, which no poster and no preview covers. */
  readonly isSceneVisible: () => boolean;
}

export class AutomaticMotion {
  readonly #view: MovingView;
  readonly #reducedMotion = matchMedia("(prefers-reduced-motion: reduce)");

  /** Follows what the user prefers until `signal` aborts. Nothing moves before `update`. */
  constructor(view: MovingView, signal: AbortSignal) {
    this.#view = view;
    this.#reducedMotion.addEventListener(
      "change",
      () => {
        this.update();
      },
      { signal },
    );
  }

  /** Call when settings have changed. */
  update(): void {
    const { cameraController, scene } = this.#view.viewer;
    const settings = this.#view.settings();
    const { paused } = settings;
    const isReduced = this.#reducedMotion.matches;
    cameraController.isInstant = isReduced;
    cameraController.autoRotation.delayMs = settings["auto-rotate-delay"];
    cameraController.autoRotation.radiansPerSecond = settings["rotation-per-second"];
    // `paused` stops all clocks, what the user prefers only those that start by themselves.
    scene.animation.setMotion(paused === true, paused === false || !isReduced);
    this.updateRotation();
  }

  /** Starts or stops automatic rotation. Call when the scene may have become visible. */
  updateRotation(): void {
    const { viewer, settings, isSceneVisible } = this.#view;
    const { autoRotation } = viewer.cameraController;
    if (!settings()["auto-rotate"] || !isSceneVisible() || this.#reducedMotion.matches) autoRotation.stop();
    else if (autoRotation.isStopped) autoRotation.start(true);
  }
}
