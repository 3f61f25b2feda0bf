// Draws the glyph atlases of texts as images.

import { drawGlyphAtlas, GlyphAtlasError } from "../text/glyphRendering.ts";
import { DecodeError } from "./decodeError.ts";

/** Draws the atlas that a file describes. Rejects with DecodeError. */
export async function glyphAtlasImage(bytes: Uint8Array<ArrayBuffer>): Promise<ImageBitmap> {
  try {
    return await drawGlyphAtlas(bytes);
  } catch (error) {
    if (error instanceof GlyphAtlasError) throw new DecodeError(error.kind, error.message);
    throw error;
  }
}
