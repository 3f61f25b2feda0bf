import assert from "node:assert/strict";
import { test } from "node:test";
import type { ShaderTexts } from "./editShaders.ts";
import { editShaders } from "./editShaders.ts";

let editCount = 0;

function edited(vertexShader: string, key: string, shaderType = "MeshPhongMaterial"): ShaderTexts {
  const shader = { vertexShader, fragmentShader: "void main() {}", shaderType };
  editShaders(shader, key, (texts) => {
    editCount += 1;
    texts.vertexShader = `${key}: ${texts.vertexShader}`;
    texts.fragmentShader = `// ${shaderType}\n${texts.fragmentShader}`;
  });
  return { vertexShader: shader.vertexShader, fragmentShader: shader.fragmentShader };
}

test("equal texts of the same type and key are edited once", () => {
  const first = edited("a", "fogs 1");
  const countAfterFirst = editCount;
  assert.deepEqual(edited("a", "fogs 1"), first);
  assert.equal(editCount, countAfterFirst);
  assert.deepEqual(first, { vertexShader: "fogs 1: a", fragmentShader: "// MeshPhongMaterial\nvoid main() {}" });
});

test("other texts, keys and types of materials are edited by themselves", () => {
  edited("a", "fogs 1");
  assert.equal(edited("b", "fogs 1").vertexShader, "fogs 1: b");
  assert.equal(edited("a", "fogs 1").vertexShader, "fogs 1: a");
  assert.equal(edited("a", "fogs 2").vertexShader, "fogs 2: a");
  assert.equal(edited("a", "fogs 1", "MeshBasicMaterial").fragmentShader, "// MeshBasicMaterial\nvoid main() {}");
});
