// Tells the nodes of a scene from the <imgeo-view>, which is a child of the same <x3d>.

import { viewTag } from "./viewStyle.ts";

/** Whether a node is part of the scene in `x3d`, not of the view that the runtime has put into it. */
export function isSceneNode(node: Node, x3d: Element): boolean {
  for (let ancestor: Node | null = node; ancestor !== null && ancestor !== x3d; ancestor = ancestor.parentNode) {
    if (ancestor.parentNode === x3d) return ancestor.nodeName.toLowerCase() !== viewTag;
  }
  return true;
}

/** The <imgeo-view> of an <x3d>; adds one if there is none. */
export function ensureViewIn(x3d: Element): HTMLElement {
  const existing = Array.from(x3d.children).find((child) => child.localName === viewTag);
  if (existing !== undefined) return existing as HTMLElement;
  const view = document.createElement(viewTag);
  x3d.append(view);
  return view;
}
