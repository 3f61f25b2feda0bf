// Adds a view to every <x3d> of the page, now and later.

import type * as alphaImage from "../decode/alphaImage.ts";
import { setAlphaImages } from "../decode/textureImage.ts";
import { defineViewer } from "../element/imgeoViewer.ts";
import { adoptPageStyle, viewTag } from "../element/viewStyle.ts";
import { ImgeoView } from "./imgeoView.ts";
import type { OverlaysModule } from "./lateOverlays.ts";
import { setOverlaysImport } from "./lateOverlays.ts";
import type { AnimationModule } from "./sceneAnimation.ts";
import { setAnimationImport } from "./sceneAnimation.ts";
import { setPartImports } from "./pageParts.ts";
import { LatePart } from "../viewer/parts/latePart.ts";
import type { PartImports } from "../viewer/parts/parts.ts";
import { ensureViewIn } from "../element/sceneNodes.ts";

type AlphaImagesModule = typeof alphaImage;

/** The modules of parts that scenes need, of overlays and animation of pages, and of what some browsers need. */
export interface PageImports extends PartImports {
  readonly overlays: () => Promise<OverlaysModule>;
  readonly animation: () => Promise<AnimationModule>;
  readonly alphaImages: () => Promise<AlphaImagesModule>;
}

function addMissingViews(): void {
  for (const x3d of document.querySelectorAll("x3d")) ensureViewIn(x3d);
}

/**
 * Defines <imgeo-viewer> and <imgeo-view>, and adds an <imgeo-view> to every <x3d>. `parts`: the modules of the runtime
 * that come when a scene needs them. A second call has no effect.
 */
export function registerViews(parts: PageImports): void {
  if (customElements.get(viewTag) !== undefined) return;
  setPartImports(parts);
  setOverlaysImport(parts.overlays);
  setAnimationImport(parts.animation);
  setAlphaImages(new LatePart(parts.alphaImages));
  defineViewer();
  customElements.define(viewTag, ImgeoView);
  adoptPageStyle(document);
  addMissingViews();
  // Also adds a view again where a page has replaced all of an <x3d>'s content.
  new MutationObserver(addMissingViews).observe(document, { subtree: true, childList: true });
}
