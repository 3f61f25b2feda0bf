import assert from "node:assert/strict";
import { test } from "node:test";
import { ShaderLib } from "three";
import { elementsOf } from "../../document/elements.testing.ts";
import { readScene } from "../../document/readScene.ts";
import { numberEffectScopes } from "../../scene/effectScope.ts";
import { InstanceTree } from "../../scene/instanceTree.ts";
import { hasLightScopes } from "../environment/effectUniforms.ts";
import { addLightScopes } from "./lightScopes.ts";
import type { SceneLightUniforms } from "./sceneLights.ts";
import { makeLights } from "./sceneLights.ts";

function uniformsOf(markup: string): SceneLightUniforms {
  const { summary } = new InstanceTree().update(readScene(elementsOf(`<X3D>${markup}</X3D>`)).root).root;
  numberEffectScopes(summary.effectScopes);
  return makeLights(summary.lights).uniforms;
}

test("programs of scenes with only global lights contain no effect scopes", () => {
  assert.ok(
    !hasLightScopes(
      uniformsOf(
        '<DirectionalLight/><Group><PointLight/><DirectionalLight global="true" ambientIntensity="1"/></Group>',
      ),
    ),
  );
  assert.ok(hasLightScopes(uniformsOf("<Group><DirectionalLight/></Group>")));
});

test("scope ranges are in the order in which three.js counts lights", () => {
  const { lightScopeRanges, scopedAmbients } = uniformsOf(`<DirectionalLight ambientIntensity="1"/>
    <Group><DirectionalLight color="1 0.5 0" ambientIntensity="0.5"/><Group><SpotLight global="false"/></Group></Group>
    <Group><PointLight global="false"/></Group>`);
  const point = [3, 3],
    spot = [2, 2],
    wholeScene = [0, 2 ** 24],
    firstGroup = [1, 2];
  assert.deepEqual(
    lightScopeRanges.value.map((range) => range.toArray()),
    [point, spot, wholeScene, firstGroup, wholeScene, wholeScene],
  );
  assert.deepEqual(
    scopedAmbients.value.map((ambient) => ambient.toArray()),
    [
      [0, 0, 0],
      [0, 0, 0],
      [0, 0, 0],
      [0.5, 0.25, 0],
      [0, 0, 0],
      [0, 0, 0],
    ],
  );
});

test("three.js' shaders test the scope of each kind of light and of ambient light", () => {
  const lit = { vertexShader: ShaderLib.phong.vertexShader, fragmentShader: ShaderLib.phong.fragmentShader };
  addLightScopes(lit);
  const lightIndices = [
    "UNROLLED_LOOP_INDEX",
    "NUM_POINT_LIGHTS + UNROLLED_LOOP_INDEX",
    "NUM_POINT_LIGHTS + NUM_SPOT_LIGHTS + UNROLLED_LOOP_INDEX",
  ];
  for (const index of lightIndices)
    assert.ok(lit.fragmentShader.includes(`directLight.color *= lightShareInScope( ${index} )`), index);
  assert.ok(lit.fragmentShader.includes("ambientLightColor + ambientLightInScope()"));
  const unlit = { vertexShader: ShaderLib.basic.vertexShader, fragmentShader: ShaderLib.basic.fragmentShader };
  addLightScopes(unlit);
  assert.deepEqual(unlit, {
    vertexShader: ShaderLib.basic.vertexShader,
    fragmentShader: ShaderLib.basic.fragmentShader,
  });
});
