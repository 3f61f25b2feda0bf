// Follows what a page changes in the elements of a view: attributes of <x3d>, slotted elements, and hotspots.

import { viewAttributes } from "../element/attributes.ts";

export interface ViewListener {
  /** An attribute of the view, or its label, has changed. */
  onAttributes(): void;
  onHotspots(): void;
}

/** Observes `x3d` and the view element in it, `host`, until `signal` aborts. */
export function observeView(x3d: Element, host: Element, listener: ViewListener, signal: AbortSignal): void {
  const childObserver = new MutationObserver(() => {
    adoptSlotted(x3d, host);
  });
  childObserver.observe(x3d, { childList: true });
  const attributeObserver = new MutationObserver(() => {
    listener.onAttributes();
  });
  attributeObserver.observe(x3d, { attributeFilter: [...Object.keys(viewAttributes), "aria-label", "title"] });
  const hotspotObserver = new MutationObserver(() => {
    listener.onHotspots();
  });
  hotspotObserver.observe(host, {
    childList: true,
    subtree: true,
    attributeFilter: ["slot", "data-position", "data-normal", "data-shape", "data-priority"],
  });
  signal.addEventListener("abort", () => {
    for (const observer of [childObserver, attributeObserver, hotspotObserver]) observer.disconnect();
  });
}

/** Moves the page's slotted elements from <x3d> into the view, whose shadow root has the slots. */
export function adoptSlotted(x3d: Element, host: Element): void {
  host.append(...Array.from(x3d.children).filter((child) => child !== host && child.hasAttribute("slot")));
}
