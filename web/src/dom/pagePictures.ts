// Loads the pictures around a scene, of its background or of its EnvironmentLight, and gives them to the renderer.

import type { DeliveryError } from "../delivery/deliveryError.ts";
import { RoleTextures } from "../delivery/roleTextures.ts";
import type { TextureImage } from "../delivery/content.ts";
import type { TextureDeliveries } from "../delivery/textureDeliveries.ts";
import { textureKeyOf } from "../delivery/textureDeliveries.ts";
import type { ImageDescription } from "../document/description.ts";

type Picture<Role> = ImageDescription & { readonly role: Role };

export interface PagePicturesHost<Role> {
  /** The pictures to be loaded; the same list while they stay the same. */
  pictures(): readonly Picture<Role>[];
  /** Displays a picture; undefined: none. */
  display(role: Role, image: TextureImage | undefined, description: Picture<Role> | undefined): void;
  onError(error: DeliveryError): void;
  onSettled(): void;
}

export class PagePictures<Role extends string> {
  readonly #host: PagePicturesHost<Role>;
  readonly #textures: RoleTextures<Role>;
  #pictures: readonly Picture<Role>[] = [];
  #keys: ReadonlySet<string> = new Set();

  constructor(deliveries: TextureDeliveries, host: PagePicturesHost<Role>) {
    this.#host = host;
    this.#textures = new RoleTextures(deliveries, {
      onTextureImage: (role, image) => {
        host.display(
          role,
          image,
          this.#pictures.find((picture) => picture.role === role),
        );
      },
      onError: (error) => {
        host.onError(error);
      },
      onSettled: () => {
        host.onSettled();
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

  /** Call when the pictures may be others. Returns whether others are to be requested. */
  follow(): boolean {
    const pictures = this.#host.pictures();
    if (pictures === this.#pictures || (pictures.length === 0 && this.#pictures.length === 0)) return false;
    this.#pictures = pictures;
    this.#keys = new Set(pictures.map(textureKeyOf));
    this.#textures.follow(pictures);
    return true;
  }

  /** Leaves all deliveries: a lost WebGL context has no pictures. `follow` joins them again. */
  suspend(): void {
    this.#textures.follow([]);
    this.#pictures = [];
  }
}
