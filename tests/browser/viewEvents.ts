// What a view tells its page about camera and poster, beside what observe.ts
// keeps of loading.

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

/** Self-contained: runs in the page before its scripts. */
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

export async function viewEvents({ page }: View, type?: string): Promise<ViewEvent[]> {
  const all = await page.evaluate(() => window.viewEvents);
  return all.filter((event) => type === undefined || event.type === type);
}
