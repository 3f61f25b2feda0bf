// Records the events of camera, poster and hotspots that a view sends to its page. pageObserver.ts records those of
// loading.

import type { View } from "./harness.ts";

export interface ViewEvent {
  type: string;
  detail: Record<string, unknown>;
}

declare global {
  interface Window {
    viewEvents: ViewEvent[];
  }
}

/** Starts recording. Self-contained: runs in the page before its scripts. */
export function recordViewEvents(): void {
  window.viewEvents = [];
  for (const type of ["camera-change", "model-visibility", "poster-dismissed", "hotspot-visibility"]) {
    document.addEventListener(
      type,
      (event) => {
        window.viewEvents.push({ type, detail: (event as CustomEvent<Record<string, unknown>>).detail });
      },
      true,
    );
  }
}

/** The recorded events, or those of one type, in order. */
export async function viewEvents({ page }: View, type?: string): Promise<ViewEvent[]> {
  const all = await page.evaluate(() => window.viewEvents);
  return all.filter((event) => type === undefined || event.type === type);
}
