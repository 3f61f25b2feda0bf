// Documents that Inlines of a scene name: asked for through the same queue as
// everything else, before it, and kept outside of any page, whose elements they
// never become. They end with the last Inline that names them.

import type { InlineDescription } from "../document/description.ts";
import type { SceneElement } from "../document/element.ts";
import type { InlinedDocument } from "../document/readScene.ts";
import type { DeliveryError } from "./deliveryError.ts";
import { asDeliveryError } from "./deliveryError.ts";
import { parseInlined } from "./inlinedDocument.ts";
import type { Transfer } from "./progress.ts";
import type { ResourceHandle, ResourcePool } from "./resourcePool.ts";

/** Before every vertex that is known already: what it holds is not even known. */
const documentWeight = 2 ** 24;
const expectedBytes = 30_000;

export interface InlinesListener {
  /** It is asked for. Not called again for the same Inline before `onLeave`. */
  onBegin?(inline: SceneElement): void;
  /** Its document is here, or none of its urls has led to one: the Inline is to be read anew. */
  onEnd(inline: SceneElement, error: DeliveryError | undefined): void;
  /** The scene no longer has it, or it names others. */
  onRemove?(inline: SceneElement): void;
}

export interface InlinesOptions {
  readonly pool: ResourcePool;
  /** The absolute url of one that an Inline names. Throws DecodeError for what must not be asked for. */
  readonly urlOf: (url: string) => string;
  /** The document that the scene begins with, which is here, though it cannot stand in itself. */
  readonly ownDocument?: InlinedDocument;
  /** The <X3D> in a document; relative urls in it become absolute. Throws DecodeError. */
  readonly parse?: (bytes: Uint8Array, url: string) => SceneElement;
}

interface Followed {
  readonly urls: readonly string[];
  handle: ResourceHandle | undefined;
  document: InlinedDocument | undefined;
  isEnded: boolean;
}

export class Inlines {
  readonly #options: InlinesOptions;
  readonly #listener: InlinesListener;
  readonly #followed = new Map<SceneElement, Followed>();
  /** By their absolute url, so that two Inlines of one document show the same shapes. */
  readonly #documents = new Map<string, InlinedDocument>();

  constructor(options: InlinesOptions, listener: InlinesListener) {
    this.#options = options;
    this.#listener = listener;
  }

  /** For who reads the scene. */
  documentOf(inline: SceneElement): InlinedDocument | undefined {
    return this.#followed.get(inline)?.document;
  }

  /** Its document has come, or none will. */
  isEnded(inline: SceneElement): boolean {
    return this.#followed.get(inline)?.isEnded === true;
  }

  /** All that are asked for have ended. */
  get isSettled(): boolean {
    return Array.from(this.#followed.values()).every(({ isEnded }) => isEnded);
  }

  /** Of the file that an Inline has asked for last. */
  transfersOf(inline: SceneElement): readonly Readonly<Transfer>[] {
    const lease = this.#followed.get(inline)?.handle;
    return lease === undefined ? [] : [lease.transfer];
  }

  get transfers(): readonly Readonly<Transfer>[] {
    return Array.from(this.#followed.keys()).flatMap((inline) => this.transfersOf(inline));
  }

  /** Asks for what is seen, and lets go of what the scene no longer has. */
  follow(described: readonly InlineDescription[]): void {
    const seen = new Map<SceneElement, InlineDescription>();
    for (const inline of described) {
      const before = seen.get(inline.element);
      if (before === undefined || inline.visible) seen.set(inline.element, inline);
    }
    for (const [element, followed] of this.#followed) {
      const inline = seen.get(element);
      if (inline !== undefined && isSame(inline.urls, followed.urls)) continue;
      this.#followed.delete(element);
      followed.handle?.release();
      this.#listener.onRemove?.(element);
    }
    for (const inline of seen.values()) this.#ask(inline);
    const inUse = new Set(Array.from(this.#followed.values(), ({ document }) => document));
    for (const [url, document] of this.#documents) if (!inUse.has(document)) this.#documents.delete(url);
  }

  dispose(): void {
    this.follow([]);
  }

  #ask({ element, urls, visible, priority }: InlineDescription): void {
    const known = this.#followed.get(element);
    known?.handle?.setPriority(priority * documentWeight);
    if (known !== undefined || !visible) return;
    const followed: Followed = { urls, handle: undefined, document: undefined, isEnded: false };
    this.#followed.set(element, followed);
    this.#listener.onBegin?.(element);
    void this.#load(element, followed, priority * documentWeight);
  }

  /** One url after the other until one leads to a document. */
  async #load(element: SceneElement, followed: Followed, priority: number): Promise<void> {
    const isOver = () => this.#followed.get(element) !== followed;
    let failure: DeliveryError | undefined;
    for (const url of followed.urls) {
      try {
        followed.document = await this.#documentAt(url, followed, priority);
        break;
      } catch (error) {
        if (isOver()) return;
        failure = asDeliveryError(error, url);
      }
    }
    if (isOver()) return;
    followed.isEnded = true;
    this.#listener.onEnd(element, followed.document === undefined ? failure : undefined);
  }

  async #documentAt(named: string, followed: Followed, priority: number): Promise<InlinedDocument> {
    const { pool, urlOf, ownDocument: own, parse = parseInlined } = this.#options;
    const url = urlOf(named);
    const known = url === own?.url ? own : this.#documents.get(url);
    if (known !== undefined) return known;
    const lease = pool.acquire({ kind: "bytes", url, priority, expectedBytes });
    followed.handle?.release();
    followed.handle = lease;
    const content = await lease.content;
    try {
      const sooner = this.#documents.get(url); // for another Inline
      if (sooner !== undefined) return sooner;
      if (content.kind !== "bytes") throw new TypeError("the pool gave no bytes");
      const document = { url, x3d: parse(content.bytes, url) };
      this.#documents.set(url, document);
      return document;
    } catch (error) {
      lease.fail(error);
      throw error;
    } finally {
      lease.finish();
    }
  }
}

function isSame(a: readonly string[], b: readonly string[]): boolean {
  return a.length === b.length && a.every((url, place) => url === b[place]);
}
