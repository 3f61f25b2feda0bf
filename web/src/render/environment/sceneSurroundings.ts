// The cube maps of a scene: of its shapes, and of its EnvironmentLight.

import type { Camera, Scene, Sphere, WebGLRenderer } from "three";
import { CubeMaps } from "./cubeMaps.ts";
import type { EnvironmentUniforms } from "./effectUniforms.ts";
import { GeneratedCubeMaps } from "./generatedCubeMaps.ts";
import { SceneEnvironment } from "./sceneEnvironment.ts";

export class SceneSurroundings {
  readonly cubeMaps = new CubeMaps();
  readonly generatedCubeMaps = new GeneratedCubeMaps();
  readonly environment: SceneEnvironment;

  constructor(uniforms: EnvironmentUniforms) {
    this.environment = new SceneEnvironment(this.cubeMaps, uniforms);
  }

  /** Call before a frame. `cull` is called for each camera that draws `scene`, which fills `sphere`. */
  update(renderer: WebGLRenderer, scene: Scene, sphere: Sphere, cull: (camera: Camera, size: number) => void): void {
    this.cubeMaps.update(renderer);
    this.generatedCubeMaps.update(renderer, scene, sphere, cull);
  }

  dispose(): void {
    this.cubeMaps.dispose();
    this.generatedCubeMaps.dispose();
  }
}
