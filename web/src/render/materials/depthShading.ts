// Points that stand for a surface to come cannot be lit yet; they are darker the
// farther they are, so that they show a shape and not just its outline.

import type { WebGLProgramParametersWithUniforms } from "three";
import { replaceEach } from "../vertices/vertexChunk.ts";

export const farnessDefine = "SHADE_BY_FARNESS";

const declarations = /* glsl */ `
#ifdef ${farnessDefine}
  uniform vec2 depthRange;
  varying float vFarness;
#endif
`;
const vertexChunk = /* glsl */ `
#include <fog_vertex>
#ifdef ${farnessDefine}
  vFarness = clamp((-mvPosition.z - depthRange.x) / (depthRange.y - depthRange.x), 0.0, 1.0);
#endif
`;
const fragmentChunk = /* glsl */ `
#include <color_fragment>
#ifdef ${farnessDefine}
  diffuseColor.rgb *= 1.0 - 0.75 * smoothstep(0.15, 0.85, vFarness);
#endif
`;

/** For `onBeforeCompile`; does nothing where the material does not define it. The uniform is SceneUniforms' `depthRange`. */
export function shadeByFarnessIn(
  shader: Pick<WebGLProgramParametersWithUniforms, "vertexShader" | "fragmentShader">,
): void {
  shader.vertexShader = declarations + replaceEach(shader.vertexShader, [["#include <fog_vertex>", vertexChunk]]);
  shader.fragmentShader =
    declarations + replaceEach(shader.fragmentShader, [["#include <color_fragment>", fragmentChunk]]);
}
