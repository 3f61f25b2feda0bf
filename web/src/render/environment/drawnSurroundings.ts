// What is drawn around the shapes of a scene: the bound background; and the cube maps of shapes and of the
// EnvironmentLight, once their module has been loaded.

import type { Scene } from "three";
import type { PanoramaSide } from "../../document/description.ts";
import type { SceneElement } from "../../document/element.ts";
import type { BackgroundInstance } from "../../scene/instances.ts";
import type { DecodedImage } from "../../stage/decodedImage.ts";
import type { FrameRequests } from "../frames/frameRequests.ts";
import { SceneBackground } from "../frames/sceneBackground.ts";
import type { BuiltScene } from "../shapes/sceneShapes.ts";
import type { TextureProvider } from "../uploads/textureProvider.ts";
import type { EnvironmentUniforms } from "./effectUniforms.ts";
import { lateEnvironment } from "./lateEnvironment.ts";
import type { EnvironmentPicture, EnvironmentRole } from "./sceneEnvironment.ts";
import type { SceneSurroundings } from "./sceneSurroundings.ts";

const noPictures: readonly EnvironmentPicture[] = [];

/** A picture on the GPU. */
interface Picture {
  readonly image: DecodedImage;
}

export class DrawnSurroundings {
  readonly #background: SceneBackground;
  readonly #textures: TextureProvider;
  readonly #frames: Pick<FrameRequests, "request" | "requestPaced">;
  #late: SceneSurroundings | undefined;

  /** Adds its objects to `scene`. */
  constructor(scene: Scene, textures: TextureProvider, frames: Pick<FrameRequests, "request" | "requestPaced">) {
    this.#background = new SceneBackground(scene);
    this.#textures = textures;
    this.#frames = frames;
  }

  /** Undefined before the first scene that needs it. */
  get late(): SceneSurroundings | undefined {
    return this.#late;
  }

  /** Call before a scene is built. */
  addLate(uniforms: EnvironmentUniforms): void {
    this.#late ??= lateEnvironment.added?.surroundings(uniforms);
  }

  follow({ backgrounds, environmentLights }: BuiltScene): void {
    this.#background.follow(backgrounds);
    this.#late?.environment.follow(environmentLights);
    this.#frames.request();
  }

  /** The bound background; undefined where the scene has none. */
  get background(): BackgroundInstance | undefined {
    return this.#background.bound;
  }

  /** Binds or unbinds a background, as X3D's set_bind does. Returns false if the element is none of the scene's. */
  bindBackground(element: SceneElement, isBound: boolean): boolean {
    if (!this.#background.bind(element, isBound)) return false;
    this.#frames.request();
    return true;
  }

  /** Sets a picture of the bound background; `undefined` removes it. */
  setBackgroundPicture(side: PanoramaSide, picture: Picture | undefined): void {
    this.#background.setPicture(side, picture && this.#textures.textureOf(picture.image));
    this.drawLoaded();
  }

  /** The pictures of the scene's EnvironmentLight; the same list while they stay the same. */
  get environmentPictures(): readonly EnvironmentPicture[] {
    return this.#late?.environment.pictures ?? noPictures;
  }

  /** The EnvironmentLight; undefined where the scene has none. */
  get environmentElement(): SceneElement | undefined {
    return this.#late?.environment.element;
  }

  /** Sets a picture of the EnvironmentLight; `undefined` removes it. */
  setEnvironmentPicture(role: EnvironmentRole, picture: Picture | undefined): void {
    this.#late?.environment.setPicture(role, picture && this.#textures.textureOf(picture.image));
    this.drawLoaded();
  }

  /** A part of the scene has been loaded: requests a paced frame that draws it, also into generated cube maps. */
  drawLoaded(): void {
    this.#late?.generatedCubeMaps.invalidate();
    this.#frames.requestPaced();
  }

  dispose(): void {
    this.#late?.dispose();
    this.#background.dispose();
  }
}
