// Depth shading: points that stand in for a surface that is still loading cannot be lit. They
// darken with depth, which shows their shape and not just its outline.

import type { WebGLProgramParametersWithUniforms } from "three";
import { replaceChunks } from "../shaders/replaceChunks.ts";

export const depthShadingDefine = "SHADE_BY_DEPTH";

const declarations = /* glsl */ `
#ifdef ${depthShadingDefine}
  uniform vec2 depthRange;
  varying float vDepthFraction;
#endif
`;
const vertexChunk = /* glsl */ `
#include <fog_vertex>
#ifdef ${depthShadingDefine}
  vDepthFraction = clamp((-mvPosition.z - depthRange.x) / (depthRange.y - depthRange.x), 0.0, 1.0);
#endif
`;
const fragmentChunk = /* glsl */ `
#include <color_fragment>
#ifdef ${depthShadingDefine}
  diffuseColor.rgb *= 1.0 - 0.75 * smoothstep(0.15, 0.85, vDepthFraction);
#endif
`;

/**
 * Call in `onBeforeCompile`; affects materials that define `SHADE_BY_DEPTH`. The uniform is
 * `SceneUniforms.depthRange`.
 */
export function addDepthShading(
  shader: Pick<WebGLProgramParametersWithUniforms, "vertexShader" | "fragmentShader">,
): void {
  shader.vertexShader = declarations + replaceChunks(shader.vertexShader, [["#include <fog_vertex>", vertexChunk]]);
  shader.fragmentShader =
    declarations + replaceChunks(shader.fragmentShader, [["#include <color_fragment>", fragmentChunk]]);
}
