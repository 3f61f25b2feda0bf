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

interface Followed {
  readonly key: string;
  readonly joined: JoinedTexture;
}

export class ShapeTextures {
  readonly #deliveries: TextureDeliveries;
  readonly #listener: ShapeTexturesListener;
  #followed = new Map<TextureRole, Followed>();

  constructor(deliveries: TextureDeliveries, listener: ShapeTexturesListener) {
    this.#deliveries = deliveries;
    this.#listener = listener;
  }

  get transfers(): readonly Readonly<Transfer>[] {
    return Array.from(this.#followed.values()).flatMap(({ joined }) => joined.transfers);
  }

  /** None of their files is on its way. */
  get isSettled(): boolean {
    return Array.from(this.#followed.values()).every(({ joined }) => joined.isSettled);
  }

  /**
   * Replaces the textures. New ones are joined before old ones are left, so that shared files are not fetched again.
   */
  follow(textures: readonly TextureDescription[]): void {
    const before = this.#followed;
    this.#followed = new Map(
      textures.map((texture) => {
        const known = before.get(texture.role);
        const key = textureKeyOf(texture);
        return [texture.role, known?.key === key ? known : { key, joined: this.#join(texture) }];
      }),
    );
    const left = Array.from(before).filter(([role, followed]) => this.#followed.get(role) !== followed);
    for (const [role] of left) this.#listener.onTextureImage(role, undefined);
    for (const [, { joined }] of left) joined.cancel();
  }

  /** No call to the listener follows until the next `follow`. Pictures must no longer be used. */
  cancel(): void {
    for (const { joined } of this.#followed.values()) joined.cancel();
    this.#followed.clear();
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
