// The pictures around a scene: those of the bound background, and of the EnvironmentLight.

import { DeliveryError } from "../delivery/deliveryError.ts";
import type { TextureDeliveries } from "../delivery/textureDeliveries.ts";
import type { PanoramaPicture, PanoramaSide } from "../document/description.ts";
import type { SceneElement } from "../document/element.ts";
import type { DrawnSurroundings } from "../render/environment/drawnSurroundings.ts";
import { lateEnvironment } from "../render/environment/lateEnvironment.ts";
import type { EnvironmentRole } from "../render/environment/sceneEnvironment.ts";
import { PagePictures } from "./pagePictures.ts";

export interface PageSurroundingsListener {
  onError(error: DeliveryError, element: Element): void;
  onSettled(): void;
}

const noPictures: readonly PanoramaPicture[] = [];

export class PageSurroundings {
  readonly #background: PagePictures<PanoramaSide>;
  readonly #environment: PagePictures<EnvironmentRole>;

  constructor(drawn: DrawnSurroundings, deliveries: TextureDeliveries, listener: PageSurroundingsListener) {
    const fail = (error: DeliveryError, element: SceneElement | undefined) => {
      if (element instanceof Element) listener.onError(error, element);
    };
    const onSettled = () => {
      listener.onSettled();
    };
    this.#background = new PagePictures<PanoramaSide>(deliveries, {
      pictures: () => drawn.background?.background.pictures ?? noPictures,
      display: (side, image) => {
        drawn.setBackgroundPicture(side, image);
      },
      onError: (error) => {
        fail(error, drawn.background?.element);
      },
      onSettled,
    });
    this.#environment = new PagePictures<EnvironmentRole>(deliveries, {
      pictures: () => drawn.environmentPictures,
      display: (role, image, description) => {
        const problem = image && lateEnvironment.added?.cubeMapProblemOf(role, image.image);
        if (problem !== undefined)
          fail(new DeliveryError("unsupported", description?.urls[0] ?? "", problem), drawn.environmentElement);
        drawn.setEnvironmentPicture(role, image);
      },
      onError: (error) => {
        fail(error, drawn.environmentElement);
      },
      onSettled,
    });
  }

  /** Keys (textureKeyOf) of the pictures. */
  get textureKeys(): ReadonlySet<string> {
    return new Set([...this.#background.textureKeys, ...this.#environment.textureKeys]);
  }

  /** Whether no picture is being loaded. */
  get isSettled(): boolean {
    return this.#background.isSettled && this.#environment.isSettled;
  }

  /** Call when other nodes may be bound or on. Returns whether other pictures are to be requested. */
  follow(): boolean {
    return [this.#background.follow(), this.#environment.follow()].includes(true);
  }

  /** Leaves all deliveries: a lost WebGL context has no pictures. `follow` joins them again. */
  suspend(): void {
    this.#background.suspend();
    this.#environment.suspend();
  }
}
