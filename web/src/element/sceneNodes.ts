// Which children of an <x3d> are nodes of its scene: all but the <imgeo-view>.

import { viewTag } from "./viewStyle.ts";

/** Whether a node is part of the scene in `x3d`, not of the view that the runtime has put into it. */
export function isSceneNode(node: Node, x3d: Element): boolean {
  for (let inner: Node | null = node; inner !== null && inner !== x3d; inner = inner.parentNode) {
    if (inner.parentNode === x3d) return inner.nodeName.toLowerCase() !== viewTag;
  }
  return true;
}

/** The view in an <x3d>, which is added where it has none. */
export function ensureViewIn(x3d: Element): HTMLElement {
  const known = Array.from(x3d.children).find((child) => child.localName === viewTag);
  if (known !== undefined) return known as HTMLElement;
  const view = document.createElement(viewTag);
  x3d.append(view);
  return view;
}
