import assert from "node:assert/strict";
import { test } from "node:test";
import { elementsOf } from "../document/elements.testing.ts";
import { readScene } from "../document/readScene.ts";
import { bindableOf } from "./bindable.ts";
import { InstanceTree } from "./instanceTree.ts";

const documents: Readonly<Record<string, string>> = {
  "outer.x3d": `<X3D><Inline url="inner.x3d"/><Background skyColor="0 1 0"/></X3D>`,
  "inner.x3d": `<X3D><Background skyColor="1 0 0"/></X3D>`,
};

function skyColorsOf(own: string): unknown {
  const inlined = new Map(Object.entries(documents).map(([url, text]) => [url, { url, x3d: elementsOf(text) }]));
  const scene = readScene(elementsOf(`<X3D><Inline url="outer.x3d"/>${own}</X3D>`), {
    inlined: (inline) => inlined.get(inline.getAttribute("url") ?? ""),
  });
  const { backgrounds } = new InstanceTree().update(scene.root).root.summary;
  const colors = bindableOf(backgrounds).map(({ background }) => background.sky[0]?.color);
  assert.deepEqual(scene.background?.sky[0]?.color, colors[0], "the first is bound");
  return colors;
}

test("backgrounds of inlined documents can be bound only where the documents around them have none", () => {
  assert.deepEqual(skyColorsOf(""), [[0, 1, 0]]);
  assert.deepEqual(skyColorsOf('<Background skyColor="0 0 1"/><Background/>'), [
    [0, 0, 1],
    [0, 0, 0],
  ]);
});
