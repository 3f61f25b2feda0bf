// The test whether shaders of this GPU read images exactly. It runs after the first images are displayed, so that no
// scene waits for it.

import type { SceneRenderer } from "../render/sceneRenderer.ts";
import type { Stage } from "../stage/stage.ts";

export class TextureReadTest {
  readonly #renderer: Pick<SceneRenderer, "uploads" | "isContextLost">;
  /** Due when the first images are displayed. */
  #state: "notDue" | "due" | "running" | "ended" = "notDue";
  #readsTextures: boolean;

  constructor(renderer: Pick<SceneRenderer, "uploads" | "isContextLost">) {
    this.#renderer = renderer;
    this.#readsTextures = renderer.uploads.hasVertexTextureUnits;
  }

  /**
   * Whether shaders read vertices from images. True for every GPU with enough vertex texture units, until the test
   * fails.
   */
  get readsTextures(): boolean {
    return this.#readsTextures;
  }

  get isDue(): boolean {
    return this.#state === "due";
  }

  /** While the test is due or running, no shape completes. */
  get isPending(): boolean {
    return this.#state === "due" || this.#state === "running";
  }

  onStage(stage: Stage | undefined): void {
    if (stage?.kind === "textures" && this.#state === "notDue") this.#state = "due";
  }

  /** Resolves with whether it has failed: then what is displayed is wrong. A lost context is no failure. */
  async run(): Promise<boolean> {
    this.#state = "running";
    const reads = await this.#renderer.uploads.readsTextures();
    this.#state = "ended";
    if (reads || this.#renderer.isContextLost) return false;
    this.#readsTextures = false;
    return true;
  }
}
