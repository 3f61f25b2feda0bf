// What the previews of a page hand over to the runtime. This file imports only
// their types, so that the runtime can be bundled without their code.

import type { PrefetchedBases } from "./prefetchedBases.ts";
import type { Preview } from "./preview.ts";

const previews = new WeakMap<Element, Preview>();

/** Registers the preview in a view. */
export function registerPreview(view: Element, preview: Preview): void {
  previews.set(view, preview);
}

/** The preview in a view, if any. From now on the caller ends it. */
export function takePreview(view: Element): Preview | undefined {
  const preview = previews.get(view);
  previews.delete(view);
  preview?.hold();
  return preview;
}

let bases: Pick<PrefetchedBases, "take" | "takeGroup"> | undefined;

export function registerPrefetchedBases(prefetched: Pick<PrefetchedBases, "take" | "takeGroup">): void {
  bases = prefetched;
}

/** The bases in a file that a preview has requested; undefined if none has. From now on the caller owns them. */
export function takePrefetchedBases(url: string): ReturnType<PrefetchedBases["take"]> {
  return bases?.take(url);
}

/** The same, of the root of a mesh with levels of detail. */
export function takePrefetchedGroup(url: string): ReturnType<PrefetchedBases["takeGroup"]> {
  return bases?.takeGroup(url);
}
