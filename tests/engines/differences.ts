// How far pictures of other engines may differ from Chromium's, and why.

import type { Bounds } from "../browser/compare.ts";

/** All draw triangles by the same renderer. */
const equal: Bounds = { mean: 0.02 };

/** Browsers have rasterisers of their own for glyphs, and draw menus in their own style. */
const hasTextOrMenus = /^(Text(?!ure)|FontStyle|hall)/;
const otherGlyphs: Bounds = { mean: 1.5 };

/** Browsers have decoders of their own for AVIF, which round colours differently. */
const hasAvif = "alpha of textures";
const otherRounding: Bounds = { mean: 0.05 };

export function boundsOf(page: string): Bounds {
  if (page === hasAvif) return otherRounding;
  return hasTextOrMenus.test(page) ? otherGlyphs : equal;
}
