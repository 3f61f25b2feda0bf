// Deliveries of textures, through the same queue as vertex data: one for each file and way of sampling, however many
// shapes use it. Where the document names a small preview, it is displayed until the full image arrives, and again
// after the full image was evicted.

import type { SamplingDescription, TextureDescription } from "../document/description.ts";
import type { BudgetRequest } from "../scheduler/budget.ts";
import type { DeliveryError } from "./deliveryError.ts";
import { asDeliveryError } from "./deliveryError.ts";
import { bytesPerTexel } from "./patchFiles.ts";
import type { Transfer } from "./progress.ts";
import type { ResourceHandle, TextureImage, ResourcePool } from "./resourcePool.ts";

export interface TextureListener {
  /** A new image; undefined: none is left. The previous one must not be used after the call. */
  onTextureImage(image: TextureImage | undefined): void;
  /** Called once, when the texture has failed. */
  onError(error: DeliveryError): void;
  /** Every requested file is ready or has failed. */
  onSettled(): void;
}

/** A member's view of a texture's delivery. */
export interface JoinedTexture {
  readonly transfers: readonly Readonly<Transfer>[];
  /** None of its files is on its way. */
  readonly isSettled: boolean;
  /** No call to the listener follows. The image must no longer be used. */
  cancel(): void;
}

/** The file of a texture: the small preview, or the full image. */
export type TextureChunk = "preview" | "texture";

/** The priority of a texture's file, by the key of its image; undefined: it is not needed now. */
export type TexturePriority = (key: string, chunk: TextureChunk) => number | undefined;

/** A file of a texture, and its state. */
interface Source {
  readonly chunk: TextureChunk;
  readonly url: string;
  handle: ResourceHandle | undefined;
  state: "absent" | "requested" | "ready" | "failed";
  image: TextureImage | undefined;
  /** Bytes on the GPU: an estimate until the file has been there once. */
  storedBytes: number;
  budgetRequest: BudgetRequest | undefined;
}

interface Shared {
  readonly sampling: SamplingDescription;
  /** The preview, where there is one, before the full image. */
  readonly sources: readonly Source[];
  readonly listeners: Set<TextureListener>;
  memberCount: number;
  displayed: TextureImage | undefined;
  error: DeliveryError | undefined;
}

/** Mipmaps take a third more. An image counts as 512 x 512 texels until it is there. */
const bytesWithMipmaps = (texels: number) => (texels * bytesPerTexel * 4) / 3;
const expected = { preview: { bytes: 1500, texels: 64 * 64 }, texture: { bytes: 300_000, texels: 512 * 512 } } as const;

/** Textures of equal keys share an image. */
export function textureKeyOf({ url, preview, sampling }: TextureDescription): string {
  return JSON.stringify([url, preview, sampling]);
}

export class TextureDeliveries {
  readonly #pool: ResourcePool;
  readonly #shared = new Map<string, Shared>();

  constructor(pool: ResourcePool) {
    this.#pool = pool;
  }

  /**
   * Requests nothing before `request`. Never calls the listener before it returns. Ends when the last member cancels.
   */
  join(texture: TextureDescription, listener: TextureListener): JoinedTexture {
    const key = textureKeyOf(texture);
    const shared = this.#shared.get(key) ?? sharedOf(texture);
    this.#shared.set(key, shared);
    shared.memberCount += 1;
    let isCancelled = false;
    queueMicrotask(() => {
      if (isCancelled) return;
      shared.listeners.add(listener);
      if (shared.displayed !== undefined) listener.onTextureImage(shared.displayed);
      if (shared.error !== undefined) listener.onError(shared.error);
      if (isSettled(shared) && !shared.sources.every(({ state }) => state === "absent")) listener.onSettled();
    });
    return {
      get transfers() {
        return transfersOf(shared);
      },
      get isSettled() {
        return isSettled(shared);
      },
      cancel: () => {
        if (isCancelled) return;
        isCancelled = true;
        shared.listeners.delete(listener);
        shared.memberCount -= 1;
        if (shared.memberCount > 0) return;
        this.#shared.delete(key);
        for (const source of shared.sources) release(source);
      },
    };
  }

  /** Estimated bytes of all textures on the GPU. */
  get storedBytes(): number {
    let bytes = 0;
    for (const { sources } of this.#shared.values())
      for (const source of sources) if (source.state !== "failed") bytes += source.storedBytes;
    return bytes;
  }

  transfers(): Readonly<Transfer>[] {
    return Array.from(this.#shared.values()).flatMap(transfersOf);
  }

  /** What each texture needs and has of the GPU: its preview before the full image. */
  budgetRequests(priorityOf: TexturePriority): readonly (readonly BudgetRequest[])[] {
    return Array.from(this.#shared, ([key, shared]) =>
      shared.sources.flatMap((source) => {
        const isUnneeded = source.chunk === "preview" && hasTexture(shared);
        const priority = isUnneeded ? undefined : priorityOf(key, source.chunk);
        source.budgetRequest =
          source.state === "failed" || (priority === undefined && source.state === "absent")
            ? undefined
            : {
                key: source,
                bytes: source.storedBytes,
                priority: priority ?? 0,
                isAllocated: source.state !== "absent",
              };
        return source.budgetRequest ?? [];
      }),
    );
  }

  /**
   * Requests the files that have a priority and aborts those without. Ready files stay; but where `granted` is given,
   * budget requests that are not in it are evicted. A preview is not requested once its full image is ready.
   */
  request(priorityOf: TexturePriority, granted?: ReadonlySet<BudgetRequest>): void {
    for (const [key, shared] of this.#shared) {
      const denied = shared.sources.filter(
        ({ budgetRequest }) => granted !== undefined && budgetRequest !== undefined && !granted.has(budgetRequest),
      );
      const evicted = denied.filter(({ state }) => state === "ready");
      if (evicted.length > 0) {
        updateDisplayed(shared, evicted);
        evicted.forEach(release);
      }
      for (const source of shared.sources) {
        if (source.state === "ready" || source.state === "failed") continue;
        const isUnneeded = denied.includes(source) || (source.chunk === "preview" && hasTexture(shared));
        const priority = isUnneeded ? undefined : priorityOf(key, source.chunk);
        if (priority === undefined) release(source);
        else if (source.handle !== undefined) source.handle.setPriority(priority);
        else this.#startRequest(shared, source, priority);
      }
    }
  }

  #startRequest(shared: Shared, source: Source, priority: number): void {
    const { url, chunk } = source;
    source.handle = this.#pool.acquire({
      kind: "textureImage",
      url,
      sampling: shared.sampling,
      priority,
      expectedBytes: expected[chunk].bytes,
    });
    source.state = "requested";
    void this.#receive(shared, source, source.handle);
  }

  async #receive(shared: Shared, source: Source, handle: ResourceHandle): Promise<void> {
    // Withdrawn meanwhile, or withdrawn and requested again.
    const isOver = () => source.handle !== handle;
    try {
      const content = await handle.content;
      if (isOver() || content.kind !== "textureImage") return;
      source.storedBytes = bytesWithMipmaps(content.image.width * content.image.height);
      source.state = "ready";
      source.image = content;
      updateDisplayed(shared);
    } catch (error) {
      if (isOver()) return;
      source.state = "failed";
      if (source.chunk === "texture") {
        shared.error = asDeliveryError(error, source.url);
        for (const listener of shared.listeners) listener.onError(shared.error);
      }
    }
    if (isSettled(shared)) for (const listener of shared.listeners) listener.onSettled();
  }
}

function sharedOf({ url, preview, sampling }: TextureDescription): Shared {
  const source = (chunk: TextureChunk, url: string): Source => ({
    chunk,
    url,
    handle: undefined,
    state: "absent",
    image: undefined,
    storedBytes: bytesWithMipmaps(expected[chunk].texels),
    budgetRequest: undefined,
  });
  return {
    sampling,
    listeners: new Set(),
    memberCount: 0,
    displayed: undefined,
    error: undefined,
    sources: [...(preview === "" ? [] : [source("preview", preview)]), source("texture", url)],
  };
}

function hasTexture({ sources }: Shared): boolean {
  return sources.some(({ chunk, state }) => chunk === "texture" && state === "ready");
}

function isSettled({ sources }: Shared): boolean {
  return sources.every(({ state }) => state !== "requested");
}

function transfersOf({ sources }: Shared): Readonly<Transfer>[] {
  return sources.flatMap(({ handle }) => (handle ? [handle.transfer] : []));
}

/** Displays the best image that is ready, except those of `without`. */
function updateDisplayed(shared: Shared, without: readonly Source[] = []): void {
  const best = shared.sources.findLast((source) => source.image !== undefined && !without.includes(source))?.image;
  if (best === shared.displayed) return;
  shared.displayed = best;
  for (const listener of shared.listeners) listener.onTextureImage(best);
}

function release(source: Source): void {
  source.handle?.release();
  source.handle = undefined;
  source.image = undefined;
  if (source.state !== "failed") source.state = "absent";
}
