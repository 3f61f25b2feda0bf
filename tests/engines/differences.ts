// How far pictures of other engines may differ from Chromium's, and why.

import type { Bounds } from "../browser/compare.ts";

/** All draw triangles by the same renderer. */
const equal: Bounds = { mean: 0.02 };

/** Browsers have rasterisers of their own for glyphs, and draw menus in their own style. */
const hasTextOrMenus = /^(Text(?!ure)|FontStyle|hall)/;
const otherGlyphs: Bounds = { mean: 1.5 };

/**
 * WebKit's ImageBitmap multiplies colours by alpha and divides them again, whatever is asked for: transparent texels
 * are black, which shows at the edges of cut-outs, and where a texture's alpha is not used.
 */
const lostColors: Readonly<Record<string, Bounds>> = {
  "ImageTexture-alpha": { mean: 0.5 },
  "PixelTexture-alpha": { mean: 0.1 },
  "TextureCoordinate-mapping": { mean: 3 },
  "TextureTransform-mapping": { mean: 20 },
};

export function boundsOf(page: string, engine: string): Bounds {
  if (engine === "WebKit" && page in lostColors) return lostColors[page] ?? equal;
  return hasTextOrMenus.test(page) ? otherGlyphs : equal;
}
