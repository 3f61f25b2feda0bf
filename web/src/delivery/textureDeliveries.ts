// Deliveries of textures, through the same queue as vertex data: one for each file and way of sampling, however many
// shapes use it. Where the document names a small preview, it is displayed until the full picture arrives, and again
// after the full picture was evicted.

import type { SamplingDescription, TextureDescription } from "../document/description.ts";
import type { BudgetRequest } from "../scheduler/budget.ts";
import type { DeliveryError } from "./deliveryError.ts";
import { asDeliveryError } from "./deliveryError.ts";
import { bytesPerTexel } from "./patchFiles.ts";
import type { Transfer } from "./progress.ts";
import type { ResourceHandle, Picture, ResourcePool } from "./resourcePool.ts";

export interface TextureListener {
  /** A new picture; undefined: none is left. The previous one must not be used after the call. */
  onPicture(picture: Picture | undefined): void;
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
  /** No call to the listener follows. The picture must no longer be used. */
  cancel(): void;
}

/** The file of a texture: the small preview, or the full picture. */
export type TextureChunk = "preview" | "texture";

/** The priority of a texture's file, by the key of its picture; undefined: it is not needed now. */
export type TexturePriority = (key: string, chunk: TextureChunk) => number | undefined;

/** A file of a texture, and its state. */
interface Source {
  readonly chunk: TextureChunk;
  readonly url: string;
  handle: ResourceHandle | undefined;
  state: "absent" | "requested" | "ready" | "failed";
  picture: Picture | undefined;
  /** Bytes on the GPU: an estimate until the file has been there once. */
  storedBytes: number;
  budgetRequest: BudgetRequest | undefined;
}

interface Shared {
  readonly sampling: SamplingDescription;
  /** The preview, where there is one, before the full picture. */
  readonly sources: readonly Source[];
  readonly listeners: Set<TextureListener>;
  memberCount: number;
  displayed: Picture | undefined;
  error: DeliveryError | undefined;
}

/** Mipmaps take a third more. A picture counts as 512 x 512 texels until it is there. */
const bytesWithMipmaps = (texels: number) => (texels * bytesPerTexel * 4) / 3;
const expected = { preview: { bytes: 1500, texels: 64 * 64 }, texture: { bytes: 300_000, texels: 512 * 512 } } as const;

/** Textures of equal keys share a picture. */
export function pictureKeyOf({ url, preview, sampling }: TextureDescription): string {
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
    const key = pictureKeyOf(texture);
    const shared = this.#shared.get(key) ?? sharedOf(texture);
    this.#shared.set(key, shared);
    shared.memberCount += 1;
    let isCancelled = false;
    queueMicrotask(() => {
      if (isCancelled) return;
      shared.listeners.add(listener);
      if (shared.displayed !== undefined) listener.onPicture(shared.displayed);
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

  /** What each texture needs and has of the GPU: its preview before the full picture. */
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
   * budget requests that are not in it are evicted. A preview is not requested once its full picture is ready.
   */
  request(priorityOf: TexturePriority, granted?: ReadonlySet<BudgetRequest>): void {
    for (const [key, shared] of this.#shared) {
      const denied = shared.sources.filter(
        ({ budgetRequest: claim }) => granted !== undefined && claim !== undefined && !granted.has(claim),
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
      kind: "picture",
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
      if (isOver() || content.kind !== "picture") return;
      source.storedBytes = bytesWithMipmaps(content.image.width * content.image.height);
      source.state = "ready";
      source.picture = content;
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
  const source = (chunk: TextureChunk, of: string): Source => ({
    chunk,
    url: of,
    handle: undefined,
    state: "absent",
    picture: undefined,
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
  return sources.flatMap(({ handle: handle }) => (handle ? [handle.transfer] : []));
}

/** Displays the best picture that is ready, except those of `without`. */
function updateDisplayed(shared: Shared, without: readonly Source[] = []): void {
  const best = shared.sources.findLast((source) => source.picture !== undefined && !without.includes(source))?.picture;
  if (best === shared.displayed) return;
  shared.displayed = best;
  for (const listener of shared.listeners) listener.onPicture(best);
}

function release(source: Source): void {
  source.handle?.release();
  source.handle = undefined;
  source.picture = undefined;
  if (source.state !== "failed") source.state = "absent";
}
