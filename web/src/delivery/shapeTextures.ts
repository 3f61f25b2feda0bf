// The textures of one shape: joins the deliveries of those that its appearance names and leaves the others.

import type { TextureDescription, TextureRole } from "../document/description.ts";
import type { DeliveryError } from "./deliveryError.ts";
import type { Transfer } from "./progress.ts";
import type { TextureImage } from "./resourcePool.ts";
import type { JoinedTexture, TextureDeliveries } from "./textureDeliveries.ts";
import { textureKeyOf } from "./textureDeliveries.ts";

export interface ShapeTexturesListener {
  /** Undefined: the role has no texture any more. The previous one must not be used after the call. */
  onTextureImage(role: TextureRole, image: TextureImage | undefined): void;
  onError(error: DeliveryError): void;
  onSettled(): void;
}

/** The texture of a role. */
interface RoleTexture {
  readonly key: string;
  readonly joined: JoinedTexture;
}

export class ShapeTextures {
  readonly #deliveries: TextureDeliveries;
  readonly #listener: ShapeTexturesListener;
  #textures = new Map<TextureRole, RoleTexture>();

  constructor(deliveries: TextureDeliveries, listener: ShapeTexturesListener) {
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
  follow(textures: readonly TextureDescription[]): void {
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

  #join(texture: TextureDescription): JoinedTexture {
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
