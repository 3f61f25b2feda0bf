// What a page's first looks leave to the runtime. No code of theirs is in here, so
// that the runtime can come without it.

import type { PrefetchedBases } from "./prefetchedBases.ts";
import type { Preview } from "./preview.ts";

const looks = new WeakMap<Element, Preview>();

/** The look stands in this view. */
export function registerPreview(view: Element, look: Preview): void {
  looks.set(view, look);
}

/** The one that stands in a view; it is the caller's from now on. */
export function takePreview(view: Element): Preview | undefined {
  const look = looks.get(view);
  looks.delete(view);
  return look;
}

let bases: Pick<PrefetchedBases, "take"> | undefined;

export function registerPrefetchedBases(early: Pick<PrefetchedBases, "take">): void {
  bases = early;
}

/** The content of a file that a look has asked for, which is the caller's from now on. */
export function takePrefetchedBases(url: string): ReturnType<PrefetchedBases["take"]> {
  return bases?.take(url);
}
