// Tests what the bundler of the runtime takes for the same on all pages.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { withConstants } from "./constants.ts";

const sourceOf = (path: string): string =>
  readFileSync(join(import.meta.dirname, "../../node_modules/three/src", path), "utf8");

const changed = (path: string): string => withConstants(path, sourceOf(path));

test("what is the same on all pages is a constant", () => {
  const conversions = changed("renderers/webgl/WebGLUtils.js").replaceAll(/^import .*$/gm, "");
  assert.ok(!conversions.includes("_S3TC_") && !conversions.includes("_RGTC"));
  assert.ok(conversions.includes("if ( p === RGBAFormat ) return gl.RGBA;"));
  assert.equal(withConstants("objects/Group.js", "class Group {}"), "class Group {}");
});

test("ambient lights, directional lights, points and spots stay, and no other lights, shadows and probes", () => {
  const uniforms = changed("renderers/shaders/UniformsLib.js");
  const lights = uniforms.slice(uniforms.indexOf("\tlights: {"));
  assert.deepEqual(
    Array.from(lights.matchAll(/^\t\t(\w+): /gm), ([, name]) => name),
    ["ambientLightColor", "directionalLights", "spotLights", "pointLights"],
  );
  const state = changed("renderers/webgl/WebGLLights.js");
  assert.doesNotMatch(state, /^\t+(state|hash)\.(sun|rectArea|hemi|probe|num|\w+Shadow)\w*(\.length)? = /m);
  for (const kind of ["directional", "spot", "point"])
    assert.ok(state.includes(`state.${kind}.length = ${kind}Length;`));
  const renderer = changed("renderers/WebGLRenderer.js");
  assert.deepEqual(
    Array.from(renderer.matchAll(/uniforms\.(\w+)\.value = lights\.state/g), ([, name]) => name),
    ["ambientLightColor", "directionalLights", "spotLights", "pointLights"],
  );
});

test("programs have no uniforms of 2 x 2 matrices and of vectors of unsigned integers, and others", () => {
  const uniforms = changed("renderers/webgl/WebGLUniforms.js");
  assert.doesNotMatch(uniforms, /return setValue(M2|V[2-4]ui|T3D|T2DArray|T[16]Array)\w*;/);
  for (const setter of ["setValueV1f", "setValueM4", "setValueV1ui", "setValueT1", "setValueT6", "setValueV1iArray"])
    assert.ok(uniforms.includes(`return ${setter};`), setter);
});

test("materials, targets and items of lists have no stencils, maps, options and variants that no page has", () => {
  const material = changed("materials/Material.js");
  assert.doesNotMatch(material, /^\t\tthis\.(stencil|clip)\w+ = /m);
  for (const property of ["blending", "side", "depthTest", "polygonOffset"])
    assert.ok(material.includes(`\t\tthis.${property} = `), property);
  for (const path of ["materials/MeshBasicMaterial.js", "materials/MeshPhongMaterial.js"]) {
    assert.doesNotMatch(changed(path), /^\t\tthis\.(lightMap|alphaMap|envMap)\w* = /m);
    assert.match(changed(path), /^\t\tthis\.map = null;$/m);
  }
  assert.doesNotMatch(changed("core/RenderTarget.js"), /^\t\t\t?(this\.)?(multiview|resolveDepthBuffer)(:| =) /m);
  assert.doesNotMatch(changed("renderers/webgl/WebGLRenderLists.js"), /materialVariant: |material\.transmission/);
});

test("a version of three.js without such a text stops the build", () => {
  assert.throws(() => withConstants("math/Color.js", "class Color {}"), /has no \^Color.* any more/);
});
