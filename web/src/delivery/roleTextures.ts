// The textures of one shape, or of a background: joins the deliveries of those that the document names and leaves the
// others.

import type { ImageDescription } from "../document/description.ts";
import type { DeliveryError } from "./deliveryError.ts";
import type { Transfer } from "./progress.ts";
import type { TextureImage } from "./content.ts";
import type { JoinedTexture, TextureDeliveries } from "./textureDeliveries.ts";
import { textureKeyOf } from "./textureDeliveries.ts";

/** `Role` names the textures of one user: the role of a texture in an appearance, or the side of a panorama. */
export interface RoleTexturesListener<Role> {
  /** Undefined: the role has no texture any more. The previous one must not be used after the call. */
  onTextureImage(role: Role, image: TextureImage | undefined): void;
  onError(error: DeliveryError): void;
  onSettled(): void;
}

type RoleTextureDescription<Role> = ImageDescription & { readonly role: Role };

/** The texture of a role. */
interface RoleTexture {
  readonly key: string;
  readonly joined: JoinedTexture;
}

export class RoleTextures<Role extends string> {
  readonly #deliveries: TextureDeliveries;
  readonly #listener: RoleTexturesListener<Role>;
  #textures = new Map<Role, RoleTexture>();

  constructor(deliveries: TextureDeliveries, listener: RoleTexturesListener<Role>) {
    this.#deliveries = deliveries;
    this.#listener = listener;
  }

  get transfers(): readonly Readonly<Transfer>[] {
    return Array.from(this.#textures.values()).flatMap(({ joined }) => joined.transfers);
  }

  /** Whether no file of the textures is being loaded. */
  get isSettled(): boolean {
    return Array.from(this.#textures.values()).every(({ joined }) => joined.isSettled);
  }

  /**
   * Replaces the textures. New ones are joined before old ones are left, so that shared files are not fetched again.
   */
  follow(textures: readonly RoleTextureDescription<Role>[]): void {
    const before = this.#textures;
    this.#textures = new Map(
      textures.map((texture) => {
        const previous = before.get(texture.role);
        const key = textureKeyOf(texture);
        return [texture.role, previous?.key === key ? previous : { key, joined: this.#join(texture) }];
      }),
    );
    const left = Array.from(before).filter(([role, texture]) => this.#textures.get(role) !== texture);
    for (const [role] of left) this.#listener.onTextureImage(role, undefined);
    for (const [, { joined }] of left) joined.cancel();
  }

  /**
   * Leaves all deliveries. The listener is not called again before the next `follow`; images must no longer be used.
   */
  cancel(): void {
    for (const { joined } of this.#textures.values()) joined.cancel();
    this.#textures.clear();
  }

  #join(texture: RoleTextureDescription<Role>): JoinedTexture {
    return this.#deliveries.join(texture, {
      onTextureImage: (image) => {
        this.#listener.onTextureImage(texture.role, image);
      },
      onError: (error) => {
        this.#listener.onError(error);
      },
      onSettled: () => {
        this.#listener.onSettled();
      },
    });
  }
}
