// Draws glyphs from a texture whose alpha is the distance to their outlines (Green 2007), so that they
// are sharp from near. From far, the edge is softened as far as the field reaches, and mipmaps do the
// rest.

import type { Material, WebGLProgramParametersWithUniforms } from "three";
import type { AppearanceDescription } from "../../document/description.ts";
import { fieldSpread } from "../../text/fieldSpread.ts";
import { glyphsDefine, setDefine } from "./defines.ts";
import { replaceChunks } from "../shaders/replaceChunks.ts";

/** Fragments outside of glyphs are discarded, so that they hide nothing; before the texture has come, all are. */
const glyphsChunk = /* glsl */ `
#include <alphamap_fragment>
#ifdef ${glyphsDefine}
  #ifdef USE_MAP
    // The edge is as soft as a pixel is wide; the field rises from 0 to 1 over twice its spread.
    vec2 texelsOfPixel = fwidth(vMapUv) * vec2(textureSize(map, 0));
    float softness = clamp(length(texelsOfPixel) * ${(Math.SQRT1_2 / (2 * fieldSpread)).toFixed(6)}, 1e-4, 1.0);
    float field = texture2D(map, vMapUv).a;
    float coverage = clamp((field - 0.5) / softness + 0.5, 0.0, 1.0);
    if (coverage == 0.0) discard;
    diffuseColor.a *= coverage / field; // the map has already multiplied it by the field
  #else
    // Always true; a plain discard lets compilers drop the whole shader, and WebGL then draws nothing.
    if (diffuseColor.a >= 0.0) discard;
  #endif
#endif
`;

/** Call in `onBeforeCompile`; affects materials for which `setGlyphDefine` found a glyph texture. */
export function addGlyphField(shader: Pick<WebGLProgramParametersWithUniforms, "fragmentShader">): void {
  shader.fragmentShader = replaceChunks(shader.fragmentShader, [["#include <alphamap_fragment>", glyphsChunk]]);
}

export function hasGlyphs({ textures }: Pick<AppearanceDescription, "textures">): boolean {
  return textures.some(({ sampling }) => sampling.isDistanceField);
}

export function setGlyphDefine(material: Material, appearance: Pick<AppearanceDescription, "textures">): void {
  setDefine(material, glyphsDefine, hasGlyphs(appearance));
}
