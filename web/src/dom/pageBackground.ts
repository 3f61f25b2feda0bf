// Loads the pictures of the bound background, and gives them to the renderer.

import type { DeliveryError } from "../delivery/deliveryError.ts";
import { RoleTextures } from "../delivery/roleTextures.ts";
import type { TextureDeliveries } from "../delivery/textureDeliveries.ts";
import { textureKeyOf } from "../delivery/textureDeliveries.ts";
import type { PanoramaPicture, PanoramaSide } from "../document/description.ts";
import type { SceneRenderer } from "../render/sceneRenderer.ts";

export interface PageBackgroundListener {
  onError(error: DeliveryError, element: Element): void;
  onSettled(): void;
}

const noPictures: readonly PanoramaPicture[] = [];

export class PageBackground {
  readonly #renderer: SceneRenderer;
  readonly #textures: RoleTextures<PanoramaSide>;
  #pictures = noPictures;
  #keys: ReadonlySet<string> = new Set();

  constructor(renderer: SceneRenderer, deliveries: TextureDeliveries, listener: PageBackgroundListener) {
    this.#renderer = renderer;
    this.#textures = new RoleTextures(deliveries, {
      onTextureImage: (side, image) => {
        renderer.setBackgroundPicture(side, image);
      },
      onError: (error) => {
        const element = renderer.background?.element;
        if (element instanceof Element) listener.onError(error, element);
      },
      onSettled: () => {
        listener.onSettled();
      },
    });
  }

  /** Keys (textureKeyOf) of the pictures. */
  get textureKeys(): ReadonlySet<string> {
    return this.#keys;
  }

  /** Whether no picture is being loaded. */
  get isSettled(): boolean {
    return this.#textures.isSettled;
  }

  /** Call when another background may be bound. Returns whether other pictures are to be requested. */
  follow(): boolean {
    const pictures = this.#renderer.background?.background.pictures ?? noPictures;
    if (pictures === this.#pictures) return false;
    this.#pictures = pictures;
    this.#keys = new Set(pictures.map(textureKeyOf));
    this.#textures.follow(pictures);
    return true;
  }

  /** Leaves all deliveries: a lost WebGL context has no pictures. `follow` joins them again. */
  suspend(): void {
    this.#textures.follow([]);
    this.#pictures = noPictures;
  }
}
