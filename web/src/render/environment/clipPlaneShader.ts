// Clip planes (clipPlanes.ts) in shaders. Programs of scenes without clip planes contain no such code.

import type { WebGLProgramParametersWithUniforms } from "three";
import { replaceChunks } from "../shaders/replaceChunks.ts";

/** Call in `onBeforeCompile`, before `viewPoint` and the draw's scope are added. */
export function addClipPlanes(shader: Pick<WebGLProgramParametersWithUniforms, "fragmentShader">, count: number): void {
  const declarations = /* glsl */ `
uniform vec4 clipPlanes[${count}];
uniform vec2 clipPlaneScopes[${count}];
`;
  const test = /* glsl */ `
#include <clipping_planes_fragment>
  for (int plane = 0; plane < ${count}; ++plane) {
    if (shareInScopes(clipPlaneScopes[plane]) > 0.0 && dot(clipPlanes[plane], vec4(viewPoint, 1.0)) < 0.0) discard;
  }
`;
  shader.fragmentShader =
    declarations + replaceChunks(shader.fragmentShader, [["#include <clipping_planes_fragment>", test]]);
}
