// The Inlines of a page's scene: sends the events and settles the promises of their elements.

import type { DeliveryError } from "../delivery/deliveryError.ts";
import type { Transfer } from "../delivery/progress.ts";
import type { SceneElement } from "../document/element.ts";
import { LoadingEvents } from "./loadingEvents.ts";

export class PageInlines {
  readonly #loadings = new Map<SceneElement, LoadingEvents>();

  get loadings(): readonly LoadingEvents[] {
    return Array.from(this.#loadings.values());
  }

  /** Whether every Inline has sent its last event. */
  get isQuiet(): boolean {
    return this.loadings.every(({ isEnded }) => isEnded);
  }

  onRequested(inline: SceneElement, transfers: () => readonly Readonly<Transfer>[]): void {
    this.#loadings.set(inline, new LoadingEvents(inline as Element, transfers));
  }

  /**
   * The Inline's document has loaded, or failed with `error`; `onError` is then called before the Inline's promises
   * reject.
   */
  onEnd(
    inline: SceneElement,
    error: DeliveryError | undefined,
    onError: (error: DeliveryError, inline: Element, loading: LoadingEvents) => void,
  ): void {
    const loading = this.#loadings.get(inline);
    if (error === undefined) loading?.reach("full");
    else if (loading !== undefined) onError(error, inline as Element, loading);
    loading?.settle();
  }

  onRemoved(inline: SceneElement): void {
    this.#loadings.get(inline)?.abandon();
    this.#loadings.delete(inline);
  }

  /** Sends the events that wait for a frame. */
  onFrame(): void {
    for (const loading of this.loadings) loading.onFrame(false);
  }
}
