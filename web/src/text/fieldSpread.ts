/** The range of the distance field of a glyph atlas, in texels to each side of an edge. */
export const fieldSpread = 8;
