// The documents that a page's scene inlines, in the order of its Inlines.

import type { ViewerCore } from "../viewer/viewerCore.ts";
import type { PageShape } from "./pageShapes.ts";

export type InliningCore = Pick<ViewerCore<PageShape>, "scene" | "inlines">;

/** Pairs of an Inline and the <x3d> of its document, of those that have loaded. */
export function loadedInlines({ scene, inlines }: InliningCore): [inline: Element, root: Element][] {
  return (scene?.inlines ?? []).flatMap(({ element }): [Element, Element][] => {
    const root = inlines.documentOf(element)?.x3d;
    return root instanceof Element ? [[element as Element, root]] : [];
  });
}

export function inlinedRoots(core: InliningCore): Element[] {
  return loadedInlines(core).map(([, root]) => root);
}

/** The title of the first document that has one. */
export function inlinedTitle(core: InliningCore): string | undefined {
  const titles = inlinedRoots(core).map((root) => root.querySelector("WorldInfo")?.getAttribute("title"));
  return titles.find((title) => title) ?? undefined;
}
