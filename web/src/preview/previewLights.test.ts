import assert from "node:assert/strict";
import { test } from "node:test";
import { Matrix4 } from "three";
import { elementsOf } from "../document/elements.testing.ts";
import { readScene } from "../document/readScene.ts";
import { sceneScope } from "../scene/effectScope.ts";
import { instancesOf } from "../scene/sceneInstances.ts";
import type { LightUniforms } from "./previewLights.ts";
import { lightKindsOf, lightUniformsOf } from "./previewLights.ts";

function uniformsOf(
  markup: string,
  headlight: boolean,
  viewFromScene = new Matrix4(),
  effectScope = sceneScope,
): LightUniforms {
  const { lights } = instancesOf(readScene(elementsOf(`<X3D><Scene>${markup}</Scene></X3D>`)));
  return lightUniformsOf({ lights, headlight }, effectScope, viewFromScene);
}

const rounded = (values: readonly number[]) => values.map((value) => Math.round(value * 1e6) / 1e6 + 0);

test("lights have their positions and directions in view coordinates", () => {
  const viewFromScene = new Matrix4().makeTranslation(0, 0, -10);
  const { lightPositions, lightDirections, lightColors, lightCones } = uniformsOf(
    `<Transform rotation="0 1 0 1.5707963267948966" translation="1 0 0">
    <PointLight location="0 0 2" color="1 0.5 0" intensity="0.5"/>
    <SpotLight location="0 0 0" direction="0 0 -1" cutOffAngle="1" beamWidth="0.5"/></Transform><DirectionalLight direction="0 -2 0" on="false"/>`,
    false,
    viewFromScene,
  );
  assert.deepEqual(rounded(lightPositions), [3, 0, -10, 1, 0, -10]);
  assert.deepEqual(rounded(lightDirections), [0, 0, -1, -1, 0, 0]);
  assert.deepEqual(lightColors, [0.5, 0.25, 0, 1, 1, 1]);
  assert.deepEqual(rounded(lightCones), rounded([0, 0, Math.cos(1), Math.cos(0.5)]));
});

test("scaling a light scales its radius and its attenuation", () => {
  const { lightRadii, lightAttenuations } = uniformsOf(
    '<Transform scale="2 2 2"><PointLight radius="10" attenuation="1 2 4"/></Transform>',
    false,
  );
  assert.deepEqual(rounded([...lightRadii, ...lightAttenuations]), [20, 1, 1, 1]);
});

test("the headlight is an additional light, and ambient intensities add up", () => {
  const markup =
    '<DirectionalLight direction="0 -2 0" color="1 0 0" ambientIntensity="0.25"/><DirectionalLight color="0.5 0.5 0.5" ambientIntensity="0.5"/>';
  const { lightPositions, lightDirections, ambientLight } = uniformsOf(markup, true);
  assert.deepEqual(lightKindsOf({ lights: [], headlight: true }), ["directional"]);
  assert.deepEqual(lightPositions.length, 3 * 3);
  assert.deepEqual(rounded(lightDirections).slice(0, 3), [0, -1, 0]);
  assert.deepEqual(lightDirections.slice(-3), [0, 0, -1]);
  assert.deepEqual(ambientLight, [0.5, 0.25, 0.25]);
});

test("a light that is not global is black outside of its group", () => {
  const scene = readScene(
    elementsOf(`<X3D><Scene><Group><PointLight global="false" color="1 0 0" ambientIntensity="0.5"/><Shape/></Group>
    <DirectionalLight/><Shape/></Scene></X3D>`),
  );
  const { lights, shapes } = instancesOf(scene);
  const uniformsByShape = shapes.map(({ effectScope }) =>
    lightUniformsOf({ lights, headlight: true }, effectScope, new Matrix4()),
  );
  assert.deepEqual(
    uniformsByShape.map(({ lightColors }) => lightColors),
    [
      [1, 0, 0, 1, 1, 1, 1, 1, 1],
      [0, 0, 0, 1, 1, 1, 1, 1, 1],
    ],
  );
  assert.deepEqual(
    uniformsByShape.map(({ ambientLight }) => ambientLight),
    [
      [0.5, 0, 0],
      [0, 0, 0],
    ],
  );
});
