// Points are round where they are large enough to be seen as such, and points and
// lines, which have no back, are lit from whichever side they are seen.

import type { WebGLProgramParametersWithUniforms } from "three";
import type { DrawRange } from "../../stage/stage.ts";
import { pointSizeChunk, replaceEach } from "../vertices/vertexChunk.ts";

const pointsDefine = "DRAWS_POINTS";
const backlessDefine = "HAS_NO_BACK";

/** From so many device pixels on. */
const roundFrom = "3.0";

export function primitiveDefinesOf(primitive: DrawRange["primitive"]): Record<string, string> {
  switch (primitive) {
    case "points":
      return { [pointsDefine]: "", [backlessDefine]: "" };
    case "lines":
    case "lineStrip":
      return { [backlessDefine]: "" };
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
const cutChunk = /* glsl */ `void main() {
#ifdef ${pointsDefine}
  if (vPointSize >= ${roundFrom} && distance(gl_PointCoord, vec2(0.5)) > 0.5) discard;
#endif
`;
const normalChunk = /* glsl */ `
#include <normal_fragment_begin>
#if defined(${backlessDefine}) && !defined(FLAT_SHADED)
  if (dot(normal, vViewPosition) < 0.0) normal = -normal;
#endif
`;

/** For `onBeforeCompile`, after `readVerticesIn`; does nothing where the material does not define it. */
export function shapePointsIn(
  shader: Pick<WebGLProgramParametersWithUniforms, "vertexShader" | "fragmentShader">,
): void {
  shader.vertexShader = declarations + replaceEach(shader.vertexShader, [[pointSizeChunk, vertexChunk]]);
  shader.fragmentShader =
    declarations +
    replaceEach(shader.fragmentShader, [
      ["void main() {", cutChunk],
      ["#include <normal_fragment_begin>", normalChunk],
    ]);
}
