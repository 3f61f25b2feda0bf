// Fetches the files of a page's scene again, usually from the browser's cache, where the GPU has lost what was
// uploaded, or reads it wrongly. Events that have been sent are not sent again.

import type { FrameRequests } from "../render/frames/frameRequests.ts";
import type { SceneUploads } from "../render/uploads/sceneUploads.ts";
import type { TextureReadTest } from "./textureReadTest.ts";

export interface RedeliveredScene {
  /** `suspend` removes what is displayed, until `join` requests it again. */
  readonly shapes: { suspend(): void; join(): void };
  readonly surroundings: { suspend(): void; follow(): unknown };
  readonly core: { readonly control: { request(): void } };
  /** Completes shapes of which nothing more is requested. */
  onRequests(): void;
  warn(message: string): void;
}

export interface UploadingRenderer {
  readonly uploads: Pick<SceneUploads, "freeSpares">;
  readonly frames: Pick<FrameRequests, "request">;
}

export class Redelivery {
  readonly #scene: RedeliveredScene;
  readonly #renderer: UploadingRenderer;
  readonly #textureTest: Pick<TextureReadTest, "readsTextures" | "isDue" | "run">;
  readonly #signal: AbortSignal;

  /** `signal`: the scene is disposed of. */
  constructor(
    scene: RedeliveredScene,
    renderer: UploadingRenderer,
    textureTest: Pick<TextureReadTest, "readsTextures" | "isDue" | "run">,
    signal: AbortSignal,
  ) {
    this.#scene = scene;
    this.#renderer = renderer;
    this.#textureTest = textureTest;
    this.#signal = signal;
    if (!textureTest.readsTextures) this.#warnOfInexactImages();
  }

  /** Follows the WebGL context of a canvas, which the renderer follows already, so that it handles events first. */
  start(canvas: EventTarget): void {
    const signal = this.#signal;
    canvas.addEventListener(
      "webglcontextlost",
      () => {
        this.#onContextLost();
      },
      { signal },
    );
    canvas.addEventListener(
      "webglcontextrestored",
      () => {
        this.#deliverAgain();
      },
      { signal },
    );
  }

  /** Call after each frame. */
  onFrame(): void {
    if (this.#textureTest.isDue) void this.#testTextures();
  }

  /**
   * The few GPUs that fail the test display a wrong shape for as long as it takes; then all files are fetched again,
   * and decoded in workers.
   */
  async #testTextures(): Promise<void> {
    const hasFailed = await this.#textureTest.run();
    if (this.#signal.aborted) return;
    if (hasFailed) {
      this.#warnOfInexactImages();
      this.#scene.shapes.suspend();
      this.#deliverAgain();
    }
    this.#scene.onRequests();
  }

  #warnOfInexactImages(): void {
    this.#scene.warn("images cannot be read exactly on this GPU; vertices are decoded in workers");
  }

  /** Everything on the GPU is lost, and what is requested now could not be uploaded. */
  #onContextLost(): void {
    this.#scene.warn("has lost its WebGL context; the scene is displayed again when the browser restores it");
    this.#scene.shapes.suspend();
    this.#scene.surroundings.suspend();
    this.#renderer.uploads.freeSpares();
  }

  #deliverAgain(): void {
    this.#scene.shapes.join();
    this.#scene.surroundings.follow();
    this.#scene.core.control.request();
    this.#renderer.frames.request();
  }
}
