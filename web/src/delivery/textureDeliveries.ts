// Deliveries of textures, through the same queue as vertex data: one for each file and way of sampling, however many
// shapes use it. Where the document names a small preview, it is displayed until the full image arrives, and again
// after the full image was evicted.

import type { ImageDescription, SamplingDescription } from "../document/description.ts";
import type { BudgetRequest } from "../scheduler/budget.ts";
import type { DeliveryError } from "./deliveryError.ts";
import { asDeliveryError } from "./deliveryError.ts";
import { Members } from "./members.ts";
import { bytesPerTexel } from "./patchFiles.ts";
import type { Transfer } from "./progress.ts";
import type { TextureImage } from "./content.ts";
import type { ResourceHandle, ResourcePool } from "./resourcePool.ts";

export interface TextureListener {
  /** A new image; undefined: none is left. The previous one must not be used after the call. */
  onTextureImage(image: TextureImage | undefined): void;
  /** Called once, when the texture has failed. */
  onError(error: DeliveryError): void;
  /** Every requested file has loaded or failed. */
  onSettled(): void;
}

/** A shared texture as one of its members has joined it. */
export interface JoinedTexture {
  readonly transfers: readonly Readonly<Transfer>[];
  /** Whether no file of the texture is being loaded. */
  readonly isSettled: boolean;
  /** Leaves the delivery. The listener is not called again; the image must no longer be used. */
  cancel(): void;
}

/** The file of a texture: the small preview, or the full image. */
export type TextureChunk = "preview" | "texture";

/** The priority of a texture's file, by the key of its image; undefined: it is not needed now. */
export type TexturePriority = (key: string, chunk: TextureChunk) => number | undefined;

/** A file of a texture, and its state. */
interface TextureFile {
  readonly chunk: TextureChunk;
  readonly url: string;
  /** Requested in order where `url` fails. */
  readonly furtherUrls: readonly string[];
  handle: ResourceHandle | undefined;
  state: "absent" | "requested" | "ready" | "failed";
  image: TextureImage | undefined;
  /** Bytes on the GPU: an estimate until the image has been decoded once. */
  storedBytes: number;
  budgetRequest: BudgetRequest | undefined;
}

interface SharedTexture {
  readonly sampling: SamplingDescription;
  /** The preview, if there is one, before the full image. */
  readonly files: readonly TextureFile[];
  readonly members: Members<TextureListener>;
  displayed: TextureImage | undefined;
  error: DeliveryError | undefined;
}

/** Mipmaps take a third more. */
const bytesWithMipmaps = (texels: number) => (texels * bytesPerTexel * 4) / 3;
/** Estimates until an image has been decoded. */
const expected = { preview: { bytes: 1500, texels: 64 * 64 }, texture: { bytes: 300_000, texels: 512 * 512 } } as const;

/** Textures of equal keys share an image. */
export function textureKeyOf({ urls, preview, sampling }: ImageDescription): string {
  return JSON.stringify([urls, preview, sampling]);
}

export class TextureDeliveries {
  readonly #pool: ResourcePool;
  readonly #shared = new Map<string, SharedTexture>();
  #startedCount = 0;

  constructor(pool: ResourcePool) {
    this.#pool = pool;
  }

  /**
   * Requests nothing before `request`. Never calls the listener before it returns. Ends when the last member cancels.
   */
  join(texture: ImageDescription, listener: TextureListener): JoinedTexture {
    const key = textureKeyOf(texture);
    const shared = this.#shared.get(key) ?? this.#start(key, texture);
    const cancel = shared.members.join(
      listener,
      () => {
        if (shared.displayed !== undefined) listener.onTextureImage(shared.displayed);
        if (shared.error !== undefined) listener.onError(shared.error);
        if (isSettled(shared) && !shared.files.every(({ state }) => state === "absent")) listener.onSettled();
      },
      () => {
        this.#shared.delete(key);
        for (const file of shared.files) release(file);
      },
    );
    return {
      get transfers() {
        return transfersOf(shared);
      },
      get isSettled() {
        return isSettled(shared);
      },
      cancel,
    };
  }

  #start(key: string, texture: ImageDescription): SharedTexture {
    const shared = sharedOf(texture);
    this.#shared.set(key, shared);
    this.#startedCount += 1;
    return shared;
  }

  /** How many deliveries have ever been started. */
  get startedCount(): number {
    return this.#startedCount;
  }

  /** Estimated bytes of all textures on the GPU. */
  get storedBytes(): number {
    let bytes = 0;
    for (const { files } of this.#shared.values())
      for (const file of files) if (file.state !== "failed") bytes += file.storedBytes;
    return bytes;
  }

  /** Whether every image that is to be displayed at last has loaded or failed. */
  get areExhausted(): boolean {
    for (const shared of this.#shared.values())
      if (!isFullImageReady(shared) && shared.files.some(({ state }) => state !== "ready" && state !== "failed"))
        return false;
    return true;
  }

  transfers(): Readonly<Transfer>[] {
    return Array.from(this.#shared.values()).flatMap(transfersOf);
  }

  /** The GPU memory that each texture requires or holds: the preview's before the full image's. */
  budgetRequests(priorityOf: TexturePriority): readonly (readonly BudgetRequest[])[] {
    return Array.from(this.#shared, ([key, shared]) =>
      shared.files.flatMap((file) => {
        const isUnneeded = file.chunk === "preview" && isFullImageReady(shared);
        const priority = isUnneeded ? undefined : priorityOf(key, file.chunk);
        file.budgetRequest =
          file.state === "failed" || (priority === undefined && file.state === "absent")
            ? undefined
            : {
                key: file,
                bytes: file.storedBytes,
                priority: priority ?? 0,
                isAllocated: file.state !== "absent",
              };
        return file.budgetRequest ?? [];
      }),
    );
  }

  /**
   * Requests the files that have a priority and aborts those without. Ready files stay; but if `granted` is given,
   * budget requests that are not in it are evicted. A preview is not requested once its full image is ready.
   */
  request(priorityOf: TexturePriority, granted?: ReadonlySet<BudgetRequest>): void {
    for (const [key, shared] of this.#shared) {
      const denied = shared.files.filter(
        ({ budgetRequest }) => granted !== undefined && budgetRequest !== undefined && !granted.has(budgetRequest),
      );
      const evicted = denied.filter(({ state }) => state === "ready");
      if (evicted.length > 0) {
        updateDisplayed(shared, evicted);
        evicted.forEach(release);
      }
      for (const file of shared.files) {
        if (file.state === "ready" || file.state === "failed") continue;
        const isUnneeded = denied.includes(file) || (file.chunk === "preview" && isFullImageReady(shared));
        const priority = isUnneeded ? undefined : priorityOf(key, file.chunk);
        if (priority === undefined) release(file);
        else if (file.handle !== undefined) file.handle.setPriority(priority);
        else this.#startRequest(shared, file, priority);
      }
    }
  }

  #startRequest(shared: SharedTexture, file: TextureFile, priority: number): void {
    const { url, furtherUrls, chunk } = file;
    file.handle = this.#pool.acquire({
      kind: "textureImage",
      url,
      furtherUrls,
      sampling: shared.sampling,
      priority,
      expectedBytes: expected[chunk].bytes,
    });
    file.state = "requested";
    void this.#receive(shared, file, file.handle);
  }

  async #receive(shared: SharedTexture, file: TextureFile, handle: ResourceHandle): Promise<void> {
    // The file may have been released since, and requested again.
    const isReplaced = () => file.handle !== handle;
    try {
      const content = await handle.content;
      if (isReplaced() || content.kind !== "textureImage") return;
      file.storedBytes = bytesWithMipmaps(content.image.width * content.image.height);
      file.state = "ready";
      file.image = content;
      updateDisplayed(shared);
    } catch (error) {
      if (isReplaced()) return;
      file.state = "failed";
      if (file.chunk === "texture") {
        shared.error = asDeliveryError(error, file.url);
        for (const listener of shared.members) listener.onError(shared.error);
      }
    }
    if (isSettled(shared)) for (const listener of shared.members) listener.onSettled();
  }
}

function sharedOf({ urls, preview, sampling }: ImageDescription): SharedTexture {
  const makeFile = (chunk: TextureChunk, [url = "", ...furtherUrls]: readonly string[]): TextureFile => ({
    chunk,
    url,
    furtherUrls,
    handle: undefined,
    state: "absent",
    image: undefined,
    storedBytes: bytesWithMipmaps(expected[chunk].texels),
    budgetRequest: undefined,
  });
  return {
    sampling,
    members: new Members(),
    displayed: undefined,
    error: undefined,
    files: [...(preview === "" ? [] : [makeFile("preview", [preview])]), makeFile("texture", urls)],
  };
}

function isFullImageReady({ files }: SharedTexture): boolean {
  return files.some(({ chunk, state }) => chunk === "texture" && state === "ready");
}

function isSettled({ files }: SharedTexture): boolean {
  return files.every(({ state }) => state !== "requested");
}

function transfersOf({ files }: SharedTexture): Readonly<Transfer>[] {
  return files.flatMap(({ handle }) => (handle ? [handle.transfer] : []));
}

/** Displays the full image or else the preview, if ready and not in `without`. */
function updateDisplayed(shared: SharedTexture, without: readonly TextureFile[] = []): void {
  const best = shared.files.findLast((file) => file.image !== undefined && !without.includes(file))?.image;
  if (best === shared.displayed) return;
  shared.displayed = best;
  for (const listener of shared.members) listener.onTextureImage(best);
}

function release(file: TextureFile): void {
  file.handle?.release();
  file.handle = undefined;
  file.image = undefined;
  if (file.state !== "failed") file.state = "absent";
}
