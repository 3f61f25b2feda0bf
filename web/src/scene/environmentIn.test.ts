import assert from "node:assert/strict";
import { test } from "node:test";
import { sceneOf } from "../document/scenes.testing.ts";
import { hasEnvironment } from "./environmentIn.ts";

const has = (nodes: string): boolean => hasEnvironment(sceneOf(nodes).root);

test("shapes, global lights and a background of one colour have no environment", () => {
  const nodes = "<DirectionalLight/><Background skyColor='1 0 0'/><Group><PointLight/><Shape><Box/></Shape></Group>";
  assert.equal(has(nodes), false);
});

test("what is around shapes or changes how they look is an environment, at any depth", () => {
  for (const node of [
    "<Background skyColor='1 0 0 0 0 1' skyAngle='1'/>",
    "<Background groundColor='1 0 0'/>",
    "<Background transparency='0.5'/>",
    "<Background frontUrl='\"a.png\"'/>",
    "<Fog/>",
    "<LocalFog/>",
    "<ClipPlane/>",
    "<EnvironmentLight/>",
    "<Shape><Appearance><ImageCubeMapTexture url='\"a.png\"'/></Appearance><Box/></Shape>",
  ]) {
    assert.equal(has(node), true, node);
    assert.equal(has(`<Transform><Group>${node}</Group></Transform>`), true, node);
  }
});

test("so is a light of a group, which does not light the rest of the scene", () => {
  assert.equal(has("<Group><DirectionalLight/></Group>"), true);
  assert.equal(has("<Group><PointLight global='false'/></Group>"), true);
  assert.equal(has("<PointLight global='false'/>"), false);
  assert.equal(has("<Group><DirectionalLight global='true'/></Group>"), false);
});

test("a scene whose group has changed is looked at again", () => {
  const { root } = sceneOf("<Group><Shape><Box/></Shape></Group>");
  assert.equal(hasEnvironment(root), false);
  const { root: changed } = sceneOf("<Group><Shape><Box/></Shape><Fog/></Group>");
  assert.equal(hasEnvironment({ ...root, children: [...root.children, ...changed.children] }), true);
});
