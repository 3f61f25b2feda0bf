// Loads the documents that Inlines name, through the same queue as all files but with a higher priority. They are kept
// outside of the page's DOM, and freed with the last Inline that names them.

import type { InlineDescription } from "../document/description.ts";
import type { SceneElement } from "../document/element.ts";
import type { InlinedDocument } from "../document/readScene.ts";
import type { DeliveryError } from "./deliveryError.ts";
import { asDeliveryError, joinedError } from "./deliveryError.ts";
import { parseInlined } from "./inlinedDocument.ts";
import type { Transfer } from "./progress.ts";
import type { ResourceHandle, ResourcePool } from "./resourcePool.ts";

/** Documents come before all vertex data: their content is not known yet. */
const documentWeight = 2 ** 24;
const expectedBytes = 30_000;

export interface InlinesListener {
  /** The Inline's document is requested. Not called again for the same Inline before `onRemove`. */
  onBegin?(inline: SceneElement): void;
  /** The Inline's document has loaded, or all its URLs have failed. The listener reads the Inline again. */
  onEnd(inline: SceneElement, error: DeliveryError | undefined): void;
  /** The scene no longer contains the Inline, or its URLs have changed. */
  onRemove?(inline: SceneElement): void;
}

export interface InlinesOptions {
  readonly pool: ResourcePool;
  /** Makes a URL of an Inline absolute. Throws DecodeError for a URL that must not be requested. */
  readonly urlOf: (url: string) => string;
  /** The document of the scene itself, which need not be loaded. */
  readonly ownDocument?: InlinedDocument;
  /** Parses a document to its <X3D> element; relative URLs become absolute. Throws DecodeError. */
  readonly parse?: (bytes: Uint8Array, url: string) => SceneElement;
}

/** The loading of one Inline. */
interface InlineLoad {
  readonly urls: readonly string[];
  handle: ResourceHandle | undefined;
  document: InlinedDocument | undefined;
  isEnded: boolean;
}

export class Inlines {
  readonly #options: InlinesOptions;
  readonly #listener: InlinesListener;
  readonly #loads = new Map<SceneElement, InlineLoad>();
  /** By absolute URL: Inlines of one document share its shapes. */
  readonly #documents = new Map<string, InlinedDocument>();

  constructor(options: InlinesOptions, listener: InlinesListener) {
    this.#options = options;
    this.#listener = listener;
  }

  /** The document of an Inline; undefined until it has loaded. */
  documentOf(inline: SceneElement): InlinedDocument | undefined {
    return this.#loads.get(inline)?.document;
  }

  /** Whether the Inline's document has loaded or all its URLs have failed. */
  isEnded(inline: SceneElement): boolean {
    return this.#loads.get(inline)?.isEnded === true;
  }

  /** Whether every requested document has loaded or failed. */
  get isSettled(): boolean {
    return Array.from(this.#loads.values()).every(({ isEnded }) => isEnded);
  }

  /** The transfer of the URL that the Inline requested last. */
  transfersOf(inline: SceneElement): readonly Readonly<Transfer>[] {
    const handle = this.#loads.get(inline)?.handle;
    return handle === undefined ? [] : [handle.transfer];
  }

  get transfers(): readonly Readonly<Transfer>[] {
    return Array.from(this.#loads.keys()).flatMap((inline) => this.transfersOf(inline));
  }

  /** Requests the documents of visible Inlines, and releases those of Inlines that the scene no longer contains. */
  follow(described: readonly InlineDescription[]): void {
    const present = new Map<SceneElement, InlineDescription>();
    for (const inline of described) {
      const before = present.get(inline.element);
      if (before === undefined || inline.visible) present.set(inline.element, inline);
    }
    for (const [element, load] of this.#loads) {
      const inline = present.get(element);
      if (inline !== undefined && isSame(inline.urls, load.urls)) continue;
      this.#loads.delete(element);
      load.handle?.release();
      this.#listener.onRemove?.(element);
    }
    for (const inline of present.values()) this.#request(inline);
    const inUse = new Set(Array.from(this.#loads.values(), ({ document }) => document));
    for (const [url, document] of this.#documents) if (!inUse.has(document)) this.#documents.delete(url);
  }

  dispose(): void {
    this.follow([]);
  }

  #request({ element, urls, visible, priority }: InlineDescription): void {
    const known = this.#loads.get(element);
    known?.handle?.setPriority(priority * documentWeight);
    if (known !== undefined || !visible) return;
    const load: InlineLoad = { urls, handle: undefined, document: undefined, isEnded: false };
    this.#loads.set(element, load);
    this.#listener.onBegin?.(element);
    void this.#load(element, load, priority * documentWeight);
  }

  /** Tries one URL after the other until one leads to a document. */
  async #load(element: SceneElement, load: InlineLoad, priority: number): Promise<void> {
    const isReplaced = () => this.#loads.get(element) !== load;
    const failures: DeliveryError[] = [];
    for (const url of load.urls) {
      try {
        load.document = await this.#documentAt(url, load, priority);
        break;
      } catch (error) {
        if (isReplaced()) return;
        failures.push(asDeliveryError(error, url));
      }
    }
    if (isReplaced()) return;
    load.isEnded = true;
    const [first, ...others] = failures;
    this.#listener.onEnd(element, load.document || !first ? undefined : joinedError([first, ...others]));
  }

  async #documentAt(relativeUrl: string, load: InlineLoad, priority: number): Promise<InlinedDocument> {
    const { pool, urlOf, ownDocument: own, parse = parseInlined } = this.#options;
    const url = urlOf(relativeUrl);
    const known = url === own?.url ? own : this.#documents.get(url);
    if (known !== undefined) return known;
    const handle = pool.acquire({ kind: "bytes", url, priority, expectedBytes });
    load.handle?.release();
    load.handle = handle;
    const content = await handle.content;
    try {
      const loaded = this.#documents.get(url); // loaded by another Inline meanwhile
      if (loaded !== undefined) return loaded;
      if (content.kind !== "bytes") throw new TypeError("the pool gave no bytes");
      const document = { url, x3d: parse(content.bytes, url) };
      this.#documents.set(url, document);
      return document;
    } catch (error) {
      handle.fail(error);
      throw error;
    } finally {
      handle.finish();
    }
  }
}

function isSame(a: readonly string[], b: readonly string[]): boolean {
  return a.length === b.length && a.every((url, index) => url === b[index]);
}
