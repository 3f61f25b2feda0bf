// Documents that Inlines of the scene name: asked for through the same queue as
// everything else, before it, and kept outside of the page, whose elements they
// never become. They end with the last Inline that names them.

import type { DeliveryError } from "../delivery/deliveryError.ts";
import { asDeliveryError } from "../delivery/deliveryError.ts";
import type { Transfer } from "../delivery/progress.ts";
import type { Lease, ResourcePool } from "../delivery/resources.ts";
import type { InlineDescription } from "../document/description.ts";
import type { SceneElement } from "../document/element.ts";
import type { InlinedDocument } from "../document/readScene.ts";
import { parseInlined, requireHttp } from "./inlinedDocument.ts";
import { Loading } from "./loading.ts";

/** Before every vertex that is known already: what it holds is not even known. */
const documentWeight = 2 ** 24;
const expectedBytes = 30_000;

export interface InlinesListener {
  /** Something has come: the Inline is to be read anew. */
  onChange(inline: SceneElement): void;
  onError(error: DeliveryError, inline: Element, loading: Loading): void;
}

interface Followed {
  readonly urls: readonly string[];
  readonly loading: Loading;
  /** Which of its urls is tried. */
  tried: number;
  lease: Lease | undefined;
  document: InlinedDocument | undefined;
}

export class Inlines {
  readonly #pool: ResourcePool;
  readonly #resolve: (url: string) => string;
  readonly #listener: InlinesListener;
  readonly #followed = new Map<SceneElement, Followed>();
  /** By their absolute url, so that two Inlines of one document show the same shapes. */
  readonly #documents = new Map<string, InlinedDocument>();

  constructor(pool: ResourcePool, resolve: (url: string) => string, listener: InlinesListener) {
    this.#pool = pool;
    this.#resolve = resolve;
    this.#listener = listener;
  }

  /** For who reads the scene. */
  documentOf(inline: SceneElement): InlinedDocument | undefined {
    return this.#followed.get(inline)?.document;
  }

  get loadings(): readonly Loading[] {
    return Array.from(this.#followed.values(), ({ loading }) => loading);
  }

  /** The page has been told all. */
  get isQuiet(): boolean {
    return this.loadings.every(({ isEnded }) => isEnded);
  }

  /** Of those on their way. */
  get transfers(): readonly Readonly<Transfer>[] {
    return Array.from(this.#followed.values()).flatMap((followed) => transfersOf(followed));
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
      followed.lease?.release();
      followed.loading.abandon();
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
    if (known === undefined && !visible) return;
    const followed = known ?? this.#begin(element as Element, urls);
    followed.lease?.setPriority(priority * documentWeight);
    if (known === undefined) void this.#load(element as Element, followed, priority * documentWeight);
  }

  #begin(element: Element, urls: readonly string[]): Followed {
    const followed: Followed = {
      urls, tried: 0, lease: undefined, document: undefined,
      loading: new Loading(element, () => transfersOf(followed)),
    };
    this.#followed.set(element, followed);
    return followed;
  }

  /** One url after the other until one leads to a document. */
  async #load(element: Element, followed: Followed, priority: number): Promise<void> {
    const isOver = () => this.#followed.get(element) !== followed;
    let failure: DeliveryError | undefined;
    for (const url of followed.urls) {
      try {
        followed.document = await this.#documentAt(this.#resolve(url), followed, priority);
        break;
      } catch (error) {
        if (isOver()) return;
        failure = asDeliveryError(error, url);
      }
    }
    if (isOver()) return;
    if (followed.document !== undefined) followed.loading.reach("full");
    else if (failure !== undefined) this.#listener.onError(failure, element, followed.loading);
    followed.loading.settle();
    this.#listener.onChange(element);
  }

  async #documentAt(url: string, followed: Followed, priority: number): Promise<InlinedDocument> {
    const known = this.#documents.get(url);
    if (known !== undefined) return known;
    requireHttp(url);
    const lease = this.#pool.lease({ kind: "bytes", url, priority, expectedBytes });
    followed.lease?.release();
    followed.lease = lease;
    const content = await lease.content;
    try {
      const sooner = this.#documents.get(url); // for another Inline
      if (sooner !== undefined) return sooner;
      if (content.kind !== "bytes") throw new TypeError("the pool gave no bytes");
      const document = { url, x3d: parseInlined(content.bytes, url) };
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

function transfersOf({ lease }: Followed): readonly Readonly<Transfer>[] {
  return lease === undefined ? [] : [lease.transfer];
}

function isSame(a: readonly string[], b: readonly string[]): boolean {
  return a.length === b.length && a.every((url, place) => url === b[place]);
}
