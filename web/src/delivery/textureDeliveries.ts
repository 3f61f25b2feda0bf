// Pictures for surfaces, through the same queue as the data of vertices: one for
// each file and way of sampling, however many shapes show it.

import type { TextureDescription } from "../document/description.ts";
import type { DeliveryError } from "./deliveryError.ts";
import { asDeliveryError } from "./deliveryError.ts";
import { bytesPerTexel } from "./parts.ts";
import type { Transfer } from "./progress.ts";
import type { Lease, Picture, ResourcePool } from "./resources.ts";

export interface TextureListener {
  onPicture(picture: Picture): void;
  onError(error: DeliveryError): void;
  /** After either. */
  onSettled(): void;
}

/** What one of those who show a texture sees of its delivery. */
export interface JoinedTexture {
  readonly transfers: readonly Readonly<Transfer>[];
  /** It is not on its way. */
  readonly isSettled: boolean;
  /** No call to the listener follows. The picture must no longer be used. */
  cancel(): void;
}

interface Shared {
  readonly texture: TextureDescription;
  readonly listeners: Set<TextureListener>;
  members: number;
  lease: Lease | undefined;
  state: "absent" | "asked" | "here" | "failed";
  /** For those who join late. */
  told: ((listener: TextureListener) => void) | undefined;
  bytes: number;
}

/** Mipmaps are a third more; until it is here, a picture counts as one of 1024 x 1024. */
const bytesWithMipmaps = (bytes: number) => (bytes * 4) / 3;
const expectedBytes = 300_000;

/** The same for textures that can share a picture. */
export function pictureKeyOf({ url, sampling }: TextureDescription): string {
  return JSON.stringify([url, sampling]);
}

export class TextureDeliveries {
  readonly #pool: ResourcePool;
  readonly #shared = new Map<string, Shared>();

  constructor(pool: ResourcePool) {
    this.#pool = pool;
  }

  /** Asks for nothing before `demand`. Never calls the listener before it returns. The last one to cancel ends the delivery. */
  join(texture: TextureDescription, listener: TextureListener): JoinedTexture {
    const key = pictureKeyOf(texture);
    const shared = this.#shared.get(key) ?? { texture, listeners: new Set(), members: 0, lease: undefined, state: "absent", told: undefined, bytes: 0 };
    this.#shared.set(key, shared);
    shared.members += 1;
    let isCancelled = false;
    queueMicrotask(() => {
      if (isCancelled) return;
      shared.listeners.add(listener);
      shared.told?.(listener);
    });
    return {
      get transfers() { return shared.lease ? [shared.lease.transfer] : []; },
      get isSettled() { return shared.state !== "asked"; },
      cancel: () => {
        if (isCancelled) return;
        isCancelled = true;
        shared.listeners.delete(listener);
        shared.members -= 1;
        if (shared.members > 0) return;
        this.#shared.delete(key);
        shared.lease?.release();
        shared.lease = undefined;
      },
    };
  }

  /** What those take on the GPU that are here. */
  get storedBytes(): number {
    return Array.from(this.#shared.values()).reduce((sum, { bytes }) => sum + bytes, 0);
  }

  transfers(): Readonly<Transfer>[] {
    return Array.from(this.#shared.values()).flatMap(({ lease }) => (lease ? [lease.transfer] : []));
  }

  /** Asks for what is wanted, by the key of its picture, and aborts what is no longer; what is here stays. */
  demand(priorityOf: (key: string) => number | undefined): void {
    for (const [key, shared] of this.#shared) {
      if (shared.state === "here" || shared.state === "failed") continue;
      const priority = priorityOf(key);
      if (priority === undefined) {
        shared.lease?.release();
        shared.lease = undefined;
        shared.state = "absent";
      } else if (shared.lease !== undefined) {
        shared.lease.setPriority(priority);
      } else {
        this.#ask(shared, priority);
      }
    }
  }

  #ask(shared: Shared, priority: number): void {
    const { url, sampling } = shared.texture;
    shared.lease = this.#pool.lease({ kind: "picture", url, sampling, priority, expectedBytes });
    shared.state = "asked";
    void this.#await(shared, shared.lease);
  }

  async #await(shared: Shared, lease: Lease): Promise<void> {
    const isOver = () => shared.lease !== lease;
    try {
      const content = await lease.content;
      if (isOver() || content.kind !== "picture") return;
      const { width, height } = content.image;
      shared.bytes = bytesWithMipmaps(width * height * bytesPerTexel);
      shared.state = "here";
      shared.told = (listener) => { listener.onPicture(content); listener.onSettled(); };
    } catch (error) {
      if (isOver()) return;
      shared.state = "failed";
      const told = asDeliveryError(error, shared.texture.url);
      shared.told = (listener) => { listener.onError(told); listener.onSettled(); };
    }
    for (const listener of shared.listeners) shared.told(listener);
  }
}
