// The scope of a draw (scene/effectScope.ts) in fragment shaders: a uniform, or in batches a value of the
// instance's record.

import type { WebGLProgramParametersWithUniforms } from "three";
import { instancesDefine, scopesDefine } from "./instanceRecord.ts";

const fragmentChunk = /* glsl */ `
#define ${scopesDefine}
#ifdef ${instancesDefine}
  flat varying float instanceScope;
  #define drawScope instanceScope
#else
  uniform float effectScope;
  #define drawScope effectScope
#endif

// 1 if the draw is in one of the scopes from range.x to range.y, otherwise 0.
float shareInScopes(vec2 range) {
  return step(range.x, drawScope) * step(drawScope, range.y);
}
`;

/** Call in `onBeforeCompile`, after the code that uses `shareInScopes` has been added. */
export function addDrawScope(
  shader: Pick<WebGLProgramParametersWithUniforms, "vertexShader" | "fragmentShader">,
): void {
  shader.fragmentShader = fragmentChunk + shader.fragmentShader;
  shader.vertexShader = `#define ${scopesDefine}\n${shader.vertexShader}`;
}
