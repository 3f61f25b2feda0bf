import assert from "node:assert/strict";
import { describe, test } from "node:test";
import type { BackgroundNodeDescription } from "./description.ts";
import { elementsOf } from "./elements.testing.ts";
import { readScene } from "./readScene.ts";

function backgroundsIn(markup: string): BackgroundNodeDescription[] {
  return readScene(elementsOf(`<X3D>${markup}</X3D>`)).root.children.filter(
    ({ kind }) => kind === "background",
  ) as BackgroundNodeDescription[];
}

describe("a background", () => {
  test("has a ring for each angle, and a colour at each pole", () => {
    const [node] = backgroundsIn(
      '<Background skyColor="1 0 0 0 1 0 0 0 1" skyAngle="0.5" transparency="2" set_bind="true"/>',
    );
    assert.equal(node?.isBindRequested, true);
    assert.deepEqual(node.background, {
      sky: [
        { color: [1, 0, 0], angle: 0 },
        { color: [0, 1, 0], angle: 0.5 },
      ],
      ground: [],
      transparency: 1,
      pictures: [],
    });
  });

  test("is bound at the start if it is the first, or the last that asks for it", () => {
    const skyOf = (markup: string) => readScene(elementsOf(`<X3D>${markup}</X3D>`)).background?.sky[0]?.color;
    const [first, second] = ['<Background skyColor="1 0 0"/>', '<TextureBackground skyColor="0 1 0"/>'];
    assert.deepEqual(skyOf(first + second), [1, 0, 0]);
    assert.deepEqual(skyOf(`${first}${second}<Background bind="true" skyColor="0 0 1"/>`), [0, 0, 1]);
  });

  test("has the picture of each URL field, which does not repeat", () => {
    const [node] = backgroundsIn(`<Background bottomUrl='"b.png" "c.png"' frontUrl="a.png" url="x.png"/>`);
    assert.deepEqual(
      node?.background.pictures.map(({ role, urls, sampling: { wrapS, wrapT, isData } }) => [
        role,
        urls.join(" "),
        wrapS,
        wrapT,
        isData,
      ]),
      [
        ["front", "a.png", "clamp", "clamp", false],
        ["bottom", "b.png c.png", "clamp", "clamp", false],
      ],
    );
  });

  test("has the textures of a TextureBackground, wherever they are defined", () => {
    const [node] =
      backgroundsIn(`<TextureBackground skyColor="1 1 1"><ImageTexture DEF="T" containerField="topTexture" url="a.png"/>
      <ImageTexture USE="T" containerField="leftTexture"/><PixelTexture containerField="backTexture" image="1 1 3 0xff0000"/></TextureBackground>`);
    assert.deepEqual(
      node?.background.pictures.map(({ role, urls: [url] }) => [role, url?.slice(0, 10)]),
      [
        ["back", "data:image"],
        ["left", "a.png"],
        ["top", "a.png"],
      ],
    );
  });
});
