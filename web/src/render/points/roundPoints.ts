// Shader chunks for points and lines. Large points are drawn as discs. Points and lines have no back
// face, so their normals are flipped towards the viewer.

import type { WebGLProgramParametersWithUniforms } from "three";
import type { DrawRange } from "../../stage/stage.ts";
import { pointSizeChunk } from "../shaders/vertexChunk.ts";
import { replaceChunks } from "../shaders/replaceChunks.ts";

const pointsDefine = "DRAWS_POINTS";
const twoSidedLightingDefine = "LIT_FROM_BOTH_SIDES";

/** Points of at least this many device pixels are round. */
const minRoundSize = "3.0";

/** The defines of a primitive in materials with `addPrimitiveChunks`. */
export function primitiveDefinesOf(primitive: DrawRange["primitive"]): Record<string, string> {
  switch (primitive) {
    case "points":
      return { [pointsDefine]: "", [twoSidedLightingDefine]: "" };
    case "lines":
    case "lineStrip":
      return { [twoSidedLightingDefine]: "" };
    case "triangles":
    case "triangleStrip":
      return {};
  }
}

const declarations = /* glsl */ `
#ifdef ${pointsDefine}
  varying float vPointSize;
#endif
`;
const vertexChunk = /* glsl */ `
${pointSizeChunk}
#ifdef ${pointsDefine}
  vPointSize = gl_PointSize;
#endif
`;
const discardCornersChunk = /* glsl */ `void main() {
#ifdef ${pointsDefine}
  if (vPointSize >= ${minRoundSize} && distance(gl_PointCoord, vec2(0.5)) > 0.5) discard;
#endif
`;
const normalChunk = /* glsl */ `
#include <normal_fragment_begin>
#if defined(${twoSidedLightingDefine}) && !defined(FLAT_SHADED)
  if (dot(normal, vViewPosition) < 0.0) normal = -normal;
#endif
`;

/** Adds the chunks to a shader after addVertexReading; materials with `primitiveDefinesOf` make use of them. */
export function addPrimitiveChunks(
  shader: Pick<WebGLProgramParametersWithUniforms, "vertexShader" | "fragmentShader">,
): void {
  shader.vertexShader = declarations + replaceChunks(shader.vertexShader, [[pointSizeChunk, vertexChunk]]);
  shader.fragmentShader =
    declarations +
    replaceChunks(shader.fragmentShader, [
      ["void main() {", discardCornersChunk],
      ["#include <normal_fragment_begin>", normalChunk],
    ]);
}
