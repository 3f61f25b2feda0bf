import assert from "node:assert/strict";
import { test } from "node:test";
import { Color, Scene, Texture } from "three";
import { elementsOf } from "../../document/elements.testing.ts";
import { readScene } from "../../document/readScene.ts";
import { InstanceTree } from "../../scene/instanceTree.ts";
import type { BuiltScene } from "../shapes/sceneShapes.ts";
import { DrawnSurroundings } from "./drawnSurroundings.ts";

/** What is around a scene, and how many frames it has requested. */
function makeSurroundings(markup: string) {
  const scene = new Scene();
  const requested = { atOnce: 0, paced: 0 };
  const frames = {
    request: () => {
      requested.atOnce += 1;
    },
    requestPaced: () => {
      requested.paced += 1;
    },
  };
  const surroundings = new DrawnSurroundings(scene, { textureOf: () => new Texture() }, frames);
  const { root } = readScene(elementsOf(`<X3D><Scene>${markup}</Scene></X3D>`));
  const { backgrounds, environmentLights } = new InstanceTree().update(root).root.summary;
  surroundings.follow({ backgrounds, environmentLights } as BuiltScene);
  return { scene, surroundings, requested, backgrounds: Array.from(backgrounds) };
}

const [red, blue] = ["1 0 0", "0 0 1"].map((color) => `<Background skyColor='${color}'></Background>`);

test("the first background is drawn, another one once it is bound, and none that the scene does not have", () => {
  const { scene, surroundings, requested, backgrounds } = makeSurroundings(`${red}${blue}`);
  const colorOf = (): number => (scene.background as Color).getHex();
  assert.equal(colorOf(), new Color(1, 0, 0).getHex());
  const [first, second] = backgrounds;
  assert.ok(first && second);
  assert.ok(surroundings.bindBackground(second.element, true));
  assert.equal(colorOf(), new Color(0, 0, 1).getHex());
  assert.equal(surroundings.background?.element, second.element);
  assert.equal(requested.atOnce, 2);
  const [stranger] = makeSurroundings(red ?? "").backgrounds;
  assert.ok(stranger && !surroundings.bindBackground(stranger.element, true));
  assert.equal(requested.atOnce, 2);
});

test("what has been loaded is drawn in paced frames, also where no module for environments has been loaded", () => {
  const { surroundings, requested } = makeSurroundings("");
  surroundings.drawLoaded();
  surroundings.setBackgroundPicture("front", undefined);
  surroundings.setEnvironmentPicture("specular.front", undefined);
  assert.deepEqual(requested, { atOnce: 1, paced: 3 });
  assert.equal(surroundings.background, undefined);
  assert.deepEqual(surroundings.environmentPictures, []);
});
