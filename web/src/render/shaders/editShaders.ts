// three.js calls `onBeforeCompile` for each material, also for those whose program it has. A page that opens groups of
// a mesh with levels makes several materials in a frame, so the edited texts are remembered.

import type { WebGLProgramParametersWithUniforms } from "three";

export type ShaderTexts = Pick<WebGLProgramParametersWithUniforms, "vertexShader" | "fragmentShader">;

interface Edited {
  readonly before: ShaderTexts;
  readonly after: ShaderTexts;
}

const remembered = new Map<string, Edited>();

function textsOf({ vertexShader, fragmentShader }: ShaderTexts): ShaderTexts {
  return { vertexShader, fragmentShader };
}

/**
 * Edits the texts of a material's shaders by `edit`, or as it has edited the same texts before. `key` names everything
 * but the texts that the result depends on.
 */
export function editShaders(
  shader: ShaderTexts & Pick<WebGLProgramParametersWithUniforms, "shaderType">,
  key: string,
  edit: (texts: ShaderTexts) => void,
): void {
  const before = textsOf(shader);
  const typeAndKey = `${shader.shaderType} ${key}`;
  let edited = remembered.get(typeAndKey);
  // Equal texts are nearly always the same string, which is compared at once.
  if (edited?.before.vertexShader !== before.vertexShader || edited.before.fragmentShader !== before.fragmentShader) {
    const after = { ...before };
    edit(after);
    edited = { before, after };
    remembered.set(typeAndKey, edited);
  }
  shader.vertexShader = edited.after.vertexShader;
  shader.fragmentShader = edited.after.fragmentShader;
}
