// The runtime: puts a view into every <x3d> of the page, now and later.

import { stylePage, viewTag } from "./faceStyle.ts";
import { ImgeoView } from "./imgeoView.ts";

export { ImgeoView };
export type { BlobOptions, ViewElement, ViewpointEntry } from "./imgeoView.ts";
export type { ErrorDetail, Loadable, ProgressDetail, ResourceEntry } from "./loading.ts";
export type { SurfacePoint } from "./imgeoView.ts";
export type { ShapeEventProperties, ShapePointerEvent, Vector3D } from "./shapeEvents.ts";
export type { ViewStatistics } from "./viewer.ts";

function fillAll(): void {
  for (const x3d of document.querySelectorAll("x3d")) {
    const hasView = Array.from(x3d.children).some((child) => child.localName === viewTag);
    if (!hasView) x3d.append(document.createElement(viewTag));
  }
}

if (customElements.get(viewTag) === undefined) {
  customElements.define(viewTag, ImgeoView);
  stylePage(document);
  fillAll();
  // Also brings a view back where a page has replaced all of an <x3d>'s content.
  new MutationObserver(fillAll).observe(document, { subtree: true, childList: true });
}
