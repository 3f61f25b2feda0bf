// Points are round where they are large enough to be seen as such, and points and
// lines, which have no back, are lit from whichever side they are seen.

import type { WebGLProgramParametersWithUniforms } from "three";
import type { DrawRange } from "../../stage/stage.ts";
import { pointSizeChunk } from "../shaders/vertexChunk.ts";
import { replaceChunks } from "../shaders/replaceChunks.ts";

const pointsDefine = "DRAWS_POINTS";
const twoSidedLightingDefine = "LIT_FROM_BOTH_SIDES";

/** From so many device pixels on. */
const minRoundSize = "3.0";

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

/** For `onBeforeCompile`, after `readVerticesIn`; does nothing where the material does not define it. */
export function addRoundPoints(
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
