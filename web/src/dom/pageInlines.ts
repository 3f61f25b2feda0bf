// The loading of a scene's Inlines, as their elements tell it.

import type { DeliveryError } from "../delivery/deliveryError.ts";
import { requireHttp } from "../delivery/inlinedDocument.ts";
import { Inlines } from "../delivery/inlines.ts";
import type { Transfer } from "../delivery/progress.ts";
import type { ResourcePool } from "../delivery/resourcePool.ts";
import type { InlineDescription } from "../document/description.ts";
import type { SceneElement } from "../document/element.ts";
import type { InlinedDocument } from "../document/readScene.ts";
import { LoadingEvents } from "./loadingEvents.ts";

export interface PageInlinesListener {
  /** Something has come: the Inline is to be read anew. */
  onChange(inline: SceneElement): void;
  onError(error: DeliveryError, inline: Element, loading: LoadingEvents): void;
}

export class PageInlines {
  readonly #inlines: Inlines;
  readonly #loadings = new Map<SceneElement, LoadingEvents>();

  constructor(pool: ResourcePool, resolve: (url: string) => string, listener: PageInlinesListener) {
    const urlOf = (named: string) => {
      const url = resolve(named);
      requireHttp(url);
      return url;
    };
    this.#inlines = new Inlines(
      { pool, urlOf },
      {
        onBegin: (inline) => {
          this.#loadings.set(inline, new LoadingEvents(inline as Element, () => this.#inlines.transfersOf(inline)));
        },
        onEnd: (inline, error) => {
          const loading = this.#loadings.get(inline);
          if (error === undefined) loading?.reach("full");
          else if (loading !== undefined) listener.onError(error, inline as Element, loading);
          loading?.settle();
          listener.onChange(inline);
        },
        onLeave: (inline) => {
          this.#loadings.get(inline)?.abandon();
          this.#loadings.delete(inline);
        },
      },
    );
  }

  /** For who reads the scene. */
  documentOf(inline: SceneElement): InlinedDocument | undefined {
    return this.#inlines.documentOf(inline);
  }

  get loadings(): readonly LoadingEvents[] {
    return Array.from(this.#loadings.values());
  }

  /** The page has been told all. */
  get isQuiet(): boolean {
    return this.loadings.every(({ isEnded }) => isEnded);
  }

  /** Of those on their way. */
  get transfers(): readonly Readonly<Transfer>[] {
    return this.#inlines.transfers;
  }

  /** Asks for what is seen, and lets go of what the scene no longer has. */
  follow(described: readonly InlineDescription[]): void {
    this.#inlines.follow(described);
  }

  dispose(): void {
    this.#inlines.dispose();
  }
}
